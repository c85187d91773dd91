"""What the tests of the Python face share."""

from __future__ import annotations

import copy
import subprocess
import sys
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any, Literal

import pytest
from support.scenes import TINY

import pbfluids as pbf
from pbfluids import toml


@pytest.fixture(scope="module", params=["cpu", "egl"])
def backend(request: pytest.FixtureRequest) -> str:
    """Who draws."""
    return request.param


@pytest.fixture(scope="module")
def renderer(backend: Literal["cpu", "egl"]) -> Iterator[pbf.Renderer]:
    """Both of them in turn, with a small picture."""
    with pbf.Renderer(160, 120, backend=backend) as made:
        yield made


@pytest.fixture
def tiny() -> dict[str, Any]:
    """A scene of 64 particles and 3 frames, to be changed at will."""
    return copy.deepcopy(TINY)


@pytest.fixture
def tiny_file(tmp_path: Path) -> Path:
    """The same, as a file."""
    path = tmp_path / "tiny.toml"
    path.write_text(toml.dumps(TINY), encoding="utf-8")
    return path


@pytest.fixture
def outside(tmp_path: Path) -> Callable[..., subprocess.CompletedProcess[str]]:
    """Run Python code in a process of its own, outside the checkout."""

    def run(code: str, **environment: str) -> subprocess.CompletedProcess[str]:
        return subprocess.run(
            [sys.executable, "-c", code],
            cwd=tmp_path,
            env=environment or None,
            capture_output=True,
            text=True,
            check=False,
        )

    return run
