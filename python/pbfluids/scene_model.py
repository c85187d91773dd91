"""The shape of a scene file, as pydantic models.

The tables that stand for parameter structs are made from the structs' own description
(``FluidParams.describe()`` and so on): names, units, ranges, defaults and texts have one source,
the C++ struct. pydantic finds unknown keys, missing keys and wrong types; ranges are left to the
struct itself (see `scene_check`) and only shown in the JSON Schema.
"""

from __future__ import annotations

import math
from typing import Annotated, Any, Literal

from pydantic import BaseModel, BeforeValidator, ConfigDict, Field, create_model

from pbfluids import _core
from pbfluids.coloring import LEGENDS

Number = Annotated[float, Field(allow_inf_nan=False)]
Vec3 = Annotated[list[Number], Field(min_length=3, max_length=3)]
# float32 holds no more, and no fluid is as fast.
Velocity = Annotated[
    list[Annotated[Number, Field(ge=-1e30, le=1e30)]], Field(min_length=3, max_length=3)
]
Color = Annotated[list[Annotated[Number, Field(ge=0, le=1)]], Field(min_length=3, max_length=3)]
Axes = Annotated[list[bool], Field(min_length=3, max_length=3)]

ParameterStruct = (
    type[_core.FluidParams]
    | type[_core.SolverParams]
    | type[_core.Camera]
    | type[_core.RenderParams]
)

STRUCTS: dict[str, ParameterStruct] = {
    "fluid": _core.FluidParams,
    "solver": _core.SolverParams,
    "camera": _core.Camera,
    "render": _core.RenderParams,
}

# Defaults that follow from the rest of the scene; Scene works them out.
DERIVED: dict[str, dict[str, str]] = {
    "camera": {
        "eye": "in front of the domain and above it, just far enough to see all of it.",
        "target": "the middle of the domain.",
    },
    "render": {
        "radius": "1.2 times the fluid's spacing.",
        "drop_radius": "0.62 times the fluid's spacing.",
        "sphere_radius": "half the fluid's spacing.",
        "colormap": 'viridis; shuffled with color_by = "id".',
        "color_range": "what the scene's energy allows, the same for all frames.",
        "legend": "name and unit of what color_by names.",
        "particle_volume": "the cube of the fluid's spacing.",
        "background": "map with environment_map; else sky.",
        "reflection": "map with environment_map.",
        "tank_lower": "the domain's.",
        "tank_upper": "the domain's.",
    },
}

# Keys that a scene's table has beside its struct's, which knows nothing of solvers and files.
_BESIDES: dict[str, dict[str, Any]] = {
    "render": {
        "color_by": (
            Literal[tuple(LEGENDS)] | None,
            Field(default=None, description="What gives the particles their colors."),
        ),
        "environment_map": (
            str | None,
            Field(
                default=None,
                description="Panorama of light around the scene: an .hdr or .exr file. A path is "
                "relative to the scene file.",
            ),
        ),
    }
}

_KINDS: dict[str, Any] = {
    "float": float,
    "int": int,
    "bool": bool,
    "string": str,
    "vec2": Annotated[list[float], Field(min_length=2, max_length=2)],
    "vec3": Annotated[list[float], Field(min_length=3, max_length=3)],
}


def for_struct(section: str, values: dict[str, Any]) -> dict[str, Any]:
    """Leave out what a table has beside its struct's parameters, and what is not given."""
    besides = _BESIDES.get(section, {})
    return {k: v for k, v in values.items() if v is not None and k not in besides}


class Table(BaseModel):
    """A table of the file. Strict: 1.5 is no integer, "1" no number, an unknown key a fault."""

    model_config = ConfigDict(strict=True, extra="forbid")


def _infinity(value: Any) -> Any:
    """Take the words that stand for infinities in JSON, which has none."""
    return float(value) if value in ("inf", "-inf") else value


def _schema_of(field: dict[str, Any]) -> dict[str, Any]:
    """Unit and range of a field in the words of JSON Schema; a vector's range is its items'."""
    bounds: dict[str, Any] = {}
    if math.isfinite(field["least"]):
        bounds["exclusiveMinimum" if field["least_excluded"] else "minimum"] = field["least"]
    if math.isfinite(field["most"]):
        bounds["exclusiveMaximum" if field["most_excluded"] else "maximum"] = field["most"]
    if field["kind"] in ("vec2", "vec3"):
        bounds = {"items": {"type": "number", **bounds}}
    return {"unit": field["unit"], **bounds} if field["unit"] else bounds


def _table_of(section: str) -> type[Table]:
    """Make the table that takes the fields of a parameter struct."""
    fields: dict[str, Any] = {}
    for field in STRUCTS[section].describe():
        name, doc, default = field["name"], field["doc"], field["default"]
        choice = field["kind"] == "choice"
        kind = Literal[tuple(field["choices"])] if choice else _KINDS[field["kind"]]
        if isinstance(default, tuple):
            default = list(default)
        if name in DERIVED.get(section, {}):
            default, doc = None, f"{doc} Default: {DERIVED[section][name]}"
        if default is None:
            kind = kind | None
        if not field["finite"]:
            kind = Annotated[kind, BeforeValidator(_infinity)]
            default = str(default) if default in (math.inf, -math.inf) else default
        fields[name] = (
            kind,
            Field(
                default=default,
                validate_default=not field["finite"],
                description=doc,
                json_schema_extra=_schema_of(field),
            ),
        )
    fields |= _BESIDES.get(section, {})
    return create_model(section.capitalize(), __base__=Table, **fields)


class Domain(Table):
    """The box that holds the fluid. A scene without this table is open space."""

    lower: Vec3 = Field(description="Corner of the least coordinates [m].")
    upper: Vec3 = Field(description="Corner of the greatest coordinates [m].")
    periodic: Axes = Field(
        [False, False, False],
        description="Axes without walls: what leaves there comes in at the opposite face.",
    )


class Block(Table):
    """A box of fluid at rest density."""

    lower: Vec3 = Field(description="Corner of the least coordinates [m].")
    upper: Vec3 = Field(description="Corner of the greatest coordinates [m].")
    velocity: Velocity = Field([0.0, 0.0, 0.0], description="Velocity at the start [m/s].")


class Ball(Table):
    """A ball of fluid at rest density."""

    center: Vec3 = Field(description="Middle of the ball [m].")
    radius: Number = Field(gt=0, description="Radius of the ball [m].")
    velocity: Velocity = Field([0.0, 0.0, 0.0], description="Velocity at the start [m/s].")


class MeshFile(Table):
    """An opaque thing that is drawn with the fluid, which does not feel it."""

    file: str = Field(
        description="OBJ, STL, PLY or what else trimesh reads. A path is relative to the scene "
        "file.",
    )
    position: Vec3 = Field([0.0, 0.0, 0.0], description="Where the file's origin goes [m].")
    scale: Number = Field(1.0, gt=0, description="How long the file's unit is [m].")
    rotation: Vec3 = Field(
        [0.0, 0.0, 0.0],
        description="Turns about x, then y, then z, through the file's origin [degrees].",
    )
    color: Color | None = Field(None, description="Linear, 0 to 1; a gray if not given.")


# Every table below the top, by its key.
TABLES: dict[str, type[Table]] = {
    "domain": Domain,
    "blocks": Block,
    "balls": Ball,
    "meshes": MeshFile,
    **{section: _table_of(section) for section in STRUCTS},
}


class SceneTables(Table):
    """A scene: what fluid is where, how it is solved, how it is seen. SI units."""

    version: Literal[1] = Field(alias="schema", description="Version of this format.")
    name: str = Field(pattern=r"^[A-Za-z0-9_-]+$", description="Letters, digits, _ and -.")
    description: str = Field("", description="One line: what there is to see.")
    duration: Number = Field(gt=0, description="Simulated time [s].")
    # What a video file can say, and less than a frame of the shortest time steps.
    frame_rate: Number = Field(ge=1e-3, le=1e6, description="Frames per simulated second [1/s].")
    domain: Domain | None = None
    blocks: list[Block] = Field([], description="Boxes of fluid.")
    balls: list[Ball] = Field([], description="Balls of fluid.")
    meshes: list[MeshFile] = Field([], description="Opaque things in the picture.")


_SECTIONS: dict[str, Any] = {
    section: (TABLES[section], Field(default_factory=TABLES[section])) for section in STRUCTS
}
SceneModel: type[SceneTables] = create_model("Scene", __base__=SceneTables, **_SECTIONS)
