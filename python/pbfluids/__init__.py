"""Position Based Fluids and headless screen-space fluid rendering.

>>> import pbfluids as pbf
>>> scene = pbf.Scene.builtin("dam_break")
>>> with pbf.Renderer(1280, 720) as renderer:
...     for frame in scene.frames():
...         image = renderer.render(frame.positions, scene.camera, scene.render_params)

Lengths are in meters, times in seconds, masses in kilograms; y points up in the built-in scenes.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from pbfluids import _openmp as _openmp  # first: it decides how the extension is loaded
from pbfluids import errors, operators
from pbfluids._version import __version__
from pbfluids.errors import FluidError
from pbfluids.simulation import (
    Box,
    FluidParams,
    Simulation,
    SolverParams,
    StepReport,
    ball,
    block,
)

if TYPE_CHECKING:
    from pbfluids.diagnosis import doctor
    from pbfluids.render import Camera, Mesh, Renderer, RenderParams
    from pbfluids.scene import Frame, Scene
    from pbfluids.surroundings import read_environment_map, read_mesh

__all__ = [
    "Box",
    "Camera",
    "FluidError",
    "FluidParams",
    "Frame",
    "Mesh",
    "RenderParams",
    "Renderer",
    "Scene",
    "Simulation",
    "SolverParams",
    "StepReport",
    "__version__",
    "ball",
    "block",
    "doctor",
    "errors",
    "operators",
    "read_environment_map",
    "read_mesh",
]

# Scenes bring pydantic, which takes longer to import than all the rest. What draws is not there in
# a build without the renderer, which still simulates.
_LAZY = {
    "Camera": "render",
    "Frame": "scene",
    "Mesh": "render",
    "RenderParams": "render",
    "Renderer": "render",
    "Scene": "scene",
    "doctor": "diagnosis",
    "read_environment_map": "surroundings",
    "read_mesh": "surroundings",
}


def __getattr__(name: str) -> Any:
    if name not in _LAZY:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    from importlib import import_module

    value = getattr(import_module(f"{__name__}.{_LAZY[name]}"), name)
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    return __all__
