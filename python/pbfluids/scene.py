"""Scenes: what fluid is where, how it is solved and how it is seen, from a TOML file."""

from __future__ import annotations

import difflib
import math
from collections.abc import Callable, Iterator, Mapping, Sequence, Set
from dataclasses import dataclass
from importlib import resources
from pathlib import Path
from typing import Any, cast

import numpy as np
import numpy.typing as npt

from pbfluids import _core, coloring, surroundings, toml
from pbfluids.errors import InvalidParameter, SceneError
from pbfluids.scene_check import check
from pbfluids.scene_data import changed, located, plain, without_absent
from pbfluids.scene_model import SceneModel, for_struct
from pbfluids.simulation import Simulation

__all__ = ["Frame", "Scene"]


@dataclass(frozen=True)
class Frame:
    """The fluid at one moment, in stable particle order.

    Attributes
    ----------
    index
        Number of the frame; 0 is the initial state.
    time
        Simulated time [s].
    positions, velocities
        Shape (n, 3), float32 [m], [m/s]; row i is particle ``ids[i]``.
    ids
        Shape (n,), int64.
    pressures, densities
        Shape (n,), float32 [Pa], [kg/m^3], where they were asked for; else None.
    state_hash
        16 hexadecimal digits, equal for equal bits and so for any number of threads.
    report
        What the time steps since the frame before took and reached; None in frame 0.
    """

    index: int
    time: float
    positions: npt.NDArray[np.float32]
    velocities: npt.NDArray[np.float32]
    ids: npt.NDArray[np.int64]
    pressures: npt.NDArray[np.float32] | None
    densities: npt.NDArray[np.float32] | None
    state_hash: str
    report: _core.StepReport | None


class Scene:
    """A checked scene. It never changes; `replace` makes another.

    Parameters
    ----------
    data
        The scene's tables, as TOML gives them. Names of files are relative to the working
        directory.
    source
        What an error message calls the scene, for example its path.

    Raises
    ------
    SceneError
        With a line for every fault.
    """

    def __init__(self, data: Mapping[str, Any], source: str = "scene") -> None:
        tables = located(_plain(data, source), Path.cwd())
        model, faults = check(tables)
        if faults or model is None:
            raise SceneError(f"{source}: {_count(faults)}\n  " + "\n  ".join(faults))
        self._source = source
        self._data = tables
        self._tables: dict[str, Any] = model.model_dump(by_alias=True)

    @classmethod
    def load(cls, path: str | Path, **overrides: Any) -> Scene:
        """Read a scene file.

        Parameters
        ----------
        path
            A TOML file. Names of files in it are relative to it.
        **overrides
            Changes, as `replace` takes them; names of files in them are relative to the working
            directory.

        Raises
        ------
        SceneError
            If the file cannot be read, or with a line for every fault in it.
        """
        try:
            text = Path(path).read_text(encoding="utf-8")
        except (OSError, ValueError) as error:
            reason = getattr(error, "strerror", None) or error
            raise SceneError(f"{path}: cannot be read: {reason}") from error
        data = located(_parsed(text, str(path)), Path(path).parent)
        return cls(changed(data, overrides), str(path))

    @classmethod
    def builtin(cls, name: str, **overrides: Any) -> Scene:
        """Make one of the scenes that come with the package.

        Parameters
        ----------
        name
            One of `names`.
        **overrides
            Changes, as `replace` takes them: ``Scene.builtin("dam_break", spacing=0.03)``.

        Raises
        ------
        SceneError
            If there is no such scene, or with a line for every fault that the changes make.
        """
        if name not in cls.names():
            close = difflib.get_close_matches(name, cls.names(), n=1)
            hint = f'did you mean "{close[0]}"?' if close else "known: " + ", ".join(cls.names())
            raise SceneError(f'no built-in scene is called "{name}", {hint}')
        text = (_builtin_scenes() / f"{name}.toml").read_text(encoding="utf-8")
        return cls(changed(_parsed(text, name), overrides), name)

    @staticmethod
    def names() -> list[str]:
        """Names of the built-in scenes."""
        files = (file.name for file in _builtin_scenes().iterdir())
        return sorted(name.removesuffix(".toml") for name in files if name.endswith(".toml"))

    @staticmethod
    def json_schema() -> dict[str, Any]:
        """Make the JSON Schema of scene files, with the unit, range and default of each key."""
        schema = SceneModel.model_json_schema(by_alias=True)
        return {"$schema": "https://json-schema.org/draft/2020-12/schema", **schema}

    def replace(self, **overrides: Any) -> Scene:
        """Make a scene with some things changed.

        Parameters
        ----------
        **overrides
            A key of the file (``duration=1.0``), a table whose keys are merged
            (``solver={"iterations": 8}``), a dotted key (``**{"solver.iterations": 8}``), or the
            name of a parameter that only one table has (``iterations=8``).

        Raises
        ------
        SceneError
            With a line for every fault that the changes make.
        """
        return Scene(changed(self._data, overrides), self._source)

    def as_dict(self) -> dict[str, Any]:
        """Give all values, but for those that follow from the rest of the scene."""
        result: dict[str, Any] = without_absent(self._tables)
        return result

    def to_toml(self) -> str:
        """Write the scene as a file with all values, which `load` takes back."""
        return toml.dumps(self.as_dict())

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Scene) and self._tables == other._tables

    __hash__ = None  # type: ignore[assignment]

    def __repr__(self) -> str:
        return f"<Scene {self.name}: {self.duration:g} s, {self.frame_count} frames>"

    @property
    def name(self) -> str:
        """Name: letters, digits, _ and -."""
        return str(self._tables["name"])

    @property
    def description(self) -> str:
        """One line: what there is to see."""
        return str(self._tables["description"])

    @property
    def duration(self) -> float:
        """Simulated time [s]."""
        return float(self._tables["duration"])

    @property
    def frame_rate(self) -> float:
        """Frames per simulated second [1/s]."""
        return float(self._tables["frame_rate"])

    @property
    def frame_count(self) -> int:
        """Number of frames: the initial state, then as many as it takes to reach the duration."""
        return 1 + math.ceil(self.duration * self.frame_rate - 1e-6)

    @property
    def fluid(self) -> _core.FluidParams:
        """What the fluid is."""
        return _core.FluidParams(**self._given("fluid"))

    @property
    def solver(self) -> _core.SolverParams:
        """How the constraint is solved."""
        return _core.SolverParams(**self._given("solver"))

    @property
    def domain(self) -> _core.Box | None:
        """The box that holds the fluid, None for open space."""
        domain = self._tables["domain"]
        return _core.Box(**domain) if domain else None

    @property
    def camera(self) -> _core.Camera:
        """Where the scene is seen from; by default so that all of it is seen."""
        given = self._given("camera")
        lower, upper = self._bounds()
        reach = float(np.linalg.norm(upper - lower)) / 2
        target = np.asarray(given.get("target", (lower + upper) / 2), float)
        up = np.asarray(given["up"], float)
        right = np.cross(up, (0.0, 0.0, 1.0) if up[1] or not up[2] else (0.0, -1.0, 0.0))
        front = np.cross(right, up)
        view = sum(k * v / np.linalg.norm(v) for k, v in [(0.35, right), (0.35, up), (1, front)])
        distance = reach / math.sin(math.radians(given["fov_y"]) / 2)
        eye = target + distance * view / np.linalg.norm(view)
        return _core.Camera(**{"eye": eye.tolist(), "target": target.tolist(), **given})

    @property
    def render_params(self) -> _core.RenderParams:
        """How the fluid is drawn; sizes follow from its spacing, the tank from the domain."""
        spacing, domain = self.fluid.spacing, self._tables["domain"]
        given = self._given("render")
        radius = given.get("radius", 1.2 * spacing)
        derived = {
            "radius": radius,
            "drop_radius": min(0.62 * spacing, radius),
            "sphere_radius": 0.5 * spacing,
            "particle_volume": spacing**3,
        }
        if domain:
            derived |= {"tank_lower": domain["lower"], "tank_upper": domain["upper"]}
        if self._tables["render"]["environment_map"] is not None:
            derived |= {"background": "map", "reflection": "map"}
        if self.color_by is not None:
            derived |= coloring.colors_of_scene(self, self.color_by)
        return _core.RenderParams(**{**derived, **given})

    @property
    def color_by(self) -> str | None:
        """What gives the particles their colors: speed, density, pressure, id, or None."""
        color_by: str | None = self._tables["render"]["color_by"]
        return color_by

    def values(self, frame: Frame | Mapping[str, Any]) -> npt.NDArray[np.float32] | None:
        """Give what colors a frame's particles, for `Renderer.render`; None without `color_by`.

        Parameters
        ----------
        frame
            Of this scene, or the arrays of a file of a run.

        Raises
        ------
        InvalidParameter
            If the frame does not hold what is needed.
        """
        if self.color_by is None:
            return None
        return coloring.values(self.color_by, frame if isinstance(frame, Mapping) else vars(frame))

    def particles(self) -> tuple[npt.NDArray[np.float32], npt.NDArray[np.float32]]:
        """Positions and velocities at the start, each of shape (n, 3), float32 [m], [m/s]."""
        lattice = self.fluid.spacing, self.fluid.dimensions
        shapes, velocities = [], []
        for block in self._tables["blocks"]:
            shapes.append(_core.block(block["lower"], block["upper"], *lattice))
            velocities.append(block["velocity"])
        for ball in self._tables["balls"]:
            shapes.append(_core.ball(ball["center"], ball["radius"], *lattice))
            velocities.append(ball["velocity"])
        counts = [len(rows) for rows in shapes]
        positions = np.concatenate(shapes)
        if self.fluid.dimensions == 2:
            positions[:, 2] = positions[:1, 2]  # one plane, to the last bit
        return positions, np.repeat(np.array(velocities, np.float32), counts, axis=0)

    def meshes(self) -> list[_core.Mesh]:
        """Read the opaque things of the picture, for `Renderer.render`; no fluid feels them.

        Raises
        ------
        InvalidParameter
            If a file is missing or holds no mesh that can be drawn.
        MissingExtra
            If trimesh is not installed.
        """
        return [surroundings.read_mesh(**table) for table in self._tables["meshes"]]

    def environment_map(self) -> npt.NDArray[np.float32] | None:
        """Read the light around the scene, for `Renderer`; None if the scene names no file.

        Raises
        ------
        InvalidParameter
            If the file is missing or holds no light.
        MissingExtra
            If OpenImageIO is not installed.
        """
        file = self._tables["render"]["environment_map"]
        return None if file is None else surroundings.read_environment_map(file)

    def simulation(self) -> Simulation:
        """Make a simulation of the scene, at its start."""
        simulation = Simulation(self.fluid, self.solver, domain=self.domain)
        positions, velocities = self.particles()
        simulation.add_particles(positions, velocities)
        return simulation

    def frames(
        self,
        count: int | None = None,
        progress: Callable[[int, int], None] | None = None,
        *,
        fields: Sequence[str] = (),
    ) -> Iterator[Frame]:
        """Simulate, and give the fluid at each frame.

        Parameters
        ----------
        count
            Number of frames, frame 0 among them; `frame_count` if not given.
        progress
            Called before each frame is given with the number of frames done and of all.
        fields
            What frames hold beside positions, velocities and ids: "pressure", "density". What
            `color_by` names is held anyway. Each takes a sweep over all neighbors per frame.

        Yields
        ------
        Frame
            Frame 0 is the initial state; its arrays are the caller's own.

        Raises
        ------
        InvalidParameter
            If the count is not positive, or a field has another name.
        SimulationFailed
            If a step cannot be completed.
        """
        if count is not None and count < 1:
            raise InvalidParameter(f"count = {count}: must be >= 1 frame")
        coloring.check_fields(fields)
        held = {*fields, self.color_by}
        return self._simulated(self.frame_count if count is None else count, held, progress)

    def _simulated(
        self, count: int, held: Set[str | None], progress: Callable[[int, int], None] | None
    ) -> Iterator[Frame]:
        simulation = self.simulation()
        report = None
        for index in range(count):
            if index > 0:
                report = simulation.advance(1.0 / self.frame_rate)
            frame = Frame(
                index,
                simulation.time,
                simulation.positions,
                simulation.velocities,
                simulation.ids,
                simulation.pressures if "pressure" in held else None,
                simulation.densities if "density" in held else None,
                simulation.state_hash(),
                report,
            )
            if progress is not None:
                progress(index + 1, count)
            yield frame

    def _given(self, section: str) -> dict[str, Any]:
        return for_struct(section, self._tables[section])

    def _bounds(self) -> tuple[npt.NDArray[np.float64], npt.NDArray[np.float64]]:
        """Corners [m] of the domain, in open space of the fluid at the start."""
        if domain := self._tables["domain"]:
            return np.asarray(domain["lower"], float), np.asarray(domain["upper"], float)
        positions = self.particles()[0].astype(float)
        return positions.min(axis=0), positions.max(axis=0)


def _builtin_scenes() -> Any:
    return resources.files("pbfluids") / "scenes"


def _parsed(text: str, source: str) -> dict[str, Any]:
    try:
        return _plain(toml.loads(text), source)
    except toml.TOMLDecodeError as error:
        raise SceneError(f"{source}: not TOML: {error}") from error


def _plain(data: Mapping[str, Any], source: str) -> dict[str, Any]:
    try:
        return cast("dict[str, Any]", plain(data))
    except SceneError as error:
        raise SceneError(f"{source}: {error}") from error


def _count(faults: list[str]) -> str:
    return "1 fault" if len(faults) == 1 else f"{len(faults)} faults"
