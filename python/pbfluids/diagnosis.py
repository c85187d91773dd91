"""What is installed here and what is missing: ``pbfluids doctor``."""

from __future__ import annotations

import os
import platform
import warnings
from dataclasses import asdict, dataclass
from importlib import metadata
from typing import Any

from pbfluids import _core
from pbfluids._version import __version__
from pbfluids.errors import FluidError, SoftwareRendering
from pbfluids.machine import available_memory
from pbfluids.render import Camera, Renderer

__all__ = ["Diagnosis", "doctor", "examine"]

_EXTRAS = {
    "cli": ["typer", "rich"],
    "video": ["av"],
    "meshes": ["trimesh"],
    "hdr": ["OpenImageIO"],
}


@dataclass(frozen=True)
class Extra:
    """An optional part: versions of its packages, None for what is missing, and the cure."""

    packages: dict[str, str | None]
    installed: bool
    cure: str


@dataclass(frozen=True)
class Diagnosis:
    """What `examine` found."""

    pbfluids: str
    python: str
    platform: str
    build: dict[str, Any]
    cores: int
    threads: int
    memory_available: int
    can_render: bool
    egl_devices: list[dict[str, Any]]
    visible_gpus: list[str]
    renderer: dict[str, Any]
    renderer_error: str | None
    extras: dict[str, Extra]

    def as_dict(self) -> dict[str, Any]:
        """Give all of it, ready for JSON."""
        return asdict(self)

    def text(self) -> str:
        """Give all of it in lines to read."""
        facts = {
            "pbfluids": self.pbfluids,
            "python": f"{self.python} on {self.platform}",
            **{key.replace("_", " "): _words(value) for key, value in self.build.items()},
            "cores": f"{self.cores}, {self.threads} threads in use",
            "memory": f"{self.memory_available / 2**30:.1f} GiB available",
            "EGL devices": _words(device["name"] for device in self.egl_devices),
            "GPUs": _words(self.visible_gpus),
            "rendering": "yes" if self.can_render else "NO",
            **{key: _words(value) for key, value in self.renderer.items()},
        }
        lines = [f"{key:16} {value}" for key, value in facts.items()]
        if self.renderer_error is not None:
            lines += ["  " + line for line in self.renderer_error.splitlines()]
        for name, extra in self.extras.items():
            found = ", ".join(f"{key} {value or '-'}" for key, value in extra.packages.items())
            cure = "" if extra.installed else f"; missing: {extra.cure}"
            lines.append(f"{'extra ' + name:16} {found}{cure}")
        return "\n".join(lines)


def doctor() -> str:
    """Say what is installed and what is missing, with the line that cures it.

    Returns
    -------
    str
        Lines to read; `pbfluids.diagnosis.examine` gives the same as data.
    """
    return examine().text()


def examine() -> Diagnosis:
    """Look at the package, the machine, the renderer and the extras; draws one tiny picture."""
    renderer, error = _renderer()
    return Diagnosis(
        pbfluids=__version__,
        python=platform.python_version(),
        platform=platform.platform(),
        build={**_core.build_info(), "instruction_sets": _core.instruction_sets()},
        cores=len(os.sched_getaffinity(0)),
        threads=_core.usable_threads(0),
        memory_available=available_memory(),
        can_render=bool(renderer),
        egl_devices=_egl_devices(),
        visible_gpus=_core.visible_gpus(),
        renderer=renderer,
        renderer_error=error,
        extras={name: _extra(name, packages) for name, packages in _EXTRAS.items()},
    )


def _renderer() -> tuple[dict[str, Any], str | None]:
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", SoftwareRendering)  # the listing shows it
            with Renderer(16, 16) as renderer:
                renderer.render([[0, 0, 0]], Camera())
                shown = {"drawn by": renderer.description}
                return {**shown, **renderer.info, "software": renderer.software}, renderer.missing
    except FluidError as error:
        return {}, str(error)


def _egl_devices() -> list[dict[str, Any]]:
    try:
        return _core.egl_devices()
    except FluidError:  # no libEGL: what `_renderer` says
        return []


def _words(value: Any) -> str:
    if isinstance(value, bool):
        return "yes" if value else "no"
    return value if isinstance(value, str) else ", ".join(value) or "none"


def _extra(name: str, packages: list[str]) -> Extra:
    versions = {package: _version(package) for package in packages}
    return Extra(versions, None not in versions.values(), f"pip install 'pbfluids[{name}]'")


def _version(package: str) -> str | None:
    try:
        return metadata.version(package)
    except metadata.PackageNotFoundError:
        return None
