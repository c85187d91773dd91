"""The source distribution is complete, and a plain ``pip install`` of it gives a light package."""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
LIGHT = {"pbfluids", "numpy", "pydantic", "tomli"}

pytestmark = pytest.mark.slow


def run(*command: str | Path) -> str:
    done = subprocess.run(
        [str(word) for word in command], cwd=ROOT, capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout


@pytest.fixture(scope="module")
def python(tmp_path_factory):
    """Python of a new environment in which nothing but the source distribution was installed."""
    where = tmp_path_factory.mktemp("light")
    build = "import sys; from scikit_build_core.build import build_sdist; build_sdist(sys.argv[1])"
    run(sys.executable, "-c", build, where)
    (sdist,) = where.glob("pbfluids-*.tar.gz")
    assert sdist.stat().st_size < 2_000_000
    run(sys.executable, "-m", "venv", where / "venv")
    run(where / "venv" / "bin" / "python", "-m", "pip", "install", sdist)
    return where / "venv" / "bin" / "python"


def test_it_steps_a_fluid(python):
    code = (
        "import pbfluids as pbf; sim = pbf.Scene.builtin('dam_break', spacing=0.1).simulation();"
        "sim.advance(1 / 60); print(len(sim), sim.step_count)"
    )
    particles, steps = map(int, run(python, "-c", code).split())
    assert particles > 50
    assert steps >= 1


def test_it_brings_numpy_and_pydantic_and_no_extra(python):
    listed = json.loads(run(python, "-m", "pip", "list", "--format=json"))
    names = {entry["name"].lower() for entry in listed}
    assert {"pbfluids", "numpy", "pydantic"} <= names
    of_pydantic = {"pydantic-core", "pydantic_core", "annotated-types", "typing-extensions"}
    of_pydantic |= {"typing_extensions", "typing-inspection"}
    assert names - LIGHT - of_pydantic <= {"pip", "setuptools"}


def test_the_command_names_the_extra_it_needs(python):
    done = subprocess.run(
        [python.parent / "pbfluids", "--help"], capture_output=True, text=True, check=False
    )
    assert done.returncode == 1
    assert "pip install 'pbfluids[cli]'" in done.stderr
    assert "Traceback" not in done.stderr
