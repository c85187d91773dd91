"""What is installed here and what is missing: ``pbfluids doctor``."""

from __future__ import annotations

import os
import platform
from dataclasses import asdict, dataclass
from importlib import metadata
from typing import Any

from pbfluids import _core
from pbfluids._version import __version__
from pbfluids.errors import FluidError
from pbfluids.machine import available_memory
from pbfluids.render import Renderer

__all__ = ["Diagnosis", "doctor", "examine"]

_EXTRAS = {"cli": ["typer", "rich"], "video": ["av"]}


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
            **{key.replace("_", " "): value for key, value in self.build.items()},
            "cores": f"{self.cores}, {self.threads} threads in use",
            "memory": f"{self.memory_available / 2**30:.1f} GiB available",
            "rendering": "yes" if self.can_render else "NO",
            **self.renderer,
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
        build=_core.build_info(),
        cores=len(os.sched_getaffinity(0)),
        threads=_core.usable_threads(0),
        memory_available=available_memory(),
        can_render=error is None,
        renderer=renderer,
        renderer_error=error,
        extras={name: _extra(name, packages) for name, packages in _EXTRAS.items()},
    )


def _renderer() -> tuple[dict[str, Any], str | None]:
    try:
        with Renderer(16, 16) as renderer:
            return dict(renderer.info), None
    except FluidError as error:
        return {}, str(error)


def _extra(name: str, packages: list[str]) -> Extra:
    versions = {package: _version(package) for package in packages}
    return Extra(versions, None not in versions.values(), f"pip install 'pbfluids[{name}]'")


def _version(package: str) -> str | None:
    try:
        return metadata.version(package)
    except metadata.PackageNotFoundError:
        return None
