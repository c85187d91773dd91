"""Installs the C++ package once per test run, and builds programs of an outside project with it."""

from __future__ import annotations

import functools
import os
import shutil
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
PREFIX = ROOT / "build" / "test-prefix"


def run(*command: str | Path) -> str:
    """Run a command with .venv's tools first; return its output, or fail with all of it."""
    path = f"{Path(sys.executable).parent}{os.pathsep}{os.environ['PATH']}"
    done = subprocess.run(
        [str(word) for word in command],
        cwd=ROOT,
        env={**os.environ, "PATH": path},
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        check=False,
    )
    assert done.returncode == 0, f"{' '.join(map(str, command))}\n{done.stdout}"
    return done.stdout


@functools.cache
def installed_prefix() -> Path:
    """`cmake --install` of preset release; quick after `cmake --workflow --preset release`."""
    run("cmake", "--preset", "release")
    run("cmake", "--build", "--preset", "release")
    shutil.rmtree(PREFIX, ignore_errors=True)
    run("cmake", "--install", "build/release", "--prefix", PREFIX)
    return PREFIX


def run_outside(source: Path, build: Path) -> str:
    """Build `source` as the project of tests/install against the installed package; run it."""
    run(
        *("cmake", "-S", ROOT / "tests" / "install", "-B", build, "-G", "Ninja"),
        *(f"-DCMAKE_PREFIX_PATH={installed_prefix()}", f"-DOUTSIDE_SOURCE={source}"),
        "-DCMAKE_FIND_USE_PACKAGE_REGISTRY=OFF",
    )
    run("cmake", "--build", build)
    return run(build / "outside")
