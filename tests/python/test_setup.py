"""The set-up asks for one thing only where it may not help itself."""

from __future__ import annotations

import os
import subprocess
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]


def set_up(tmp_path: Path, goal: str) -> subprocess.CompletedProcess[str]:
    """Run setup.sh as a user who is not root, on a machine without a C++ compiler."""
    for name, script in {"id": "echo 1000", "sudo": "exit 1", "apt-get": "exit 99"}.items():
        stub = tmp_path / name
        stub.write_text(f"#!/bin/sh\n{script}\n", encoding="utf-8")
        stub.chmod(0o755)
    environment = {**os.environ, "PATH": f"{tmp_path}:{os.environ['PATH']}", "CXX": "no-compiler"}
    command = [ROOT / "scripts" / "setup.sh", goal]
    return subprocess.run(command, env=environment, capture_output=True, text=True, check=False)


@pytest.mark.parametrize("goal", ["demo", "test", "lint", "bench"])
def test_without_root_it_prints_the_one_line_to_run_and_stops(tmp_path, goal):
    done = set_up(tmp_path, goal)
    assert done.returncode == 1
    (line,) = done.stdout.splitlines()
    start = "sudo apt-get update && sudo apt-get install -y --no-install-recommends "
    assert line.startswith(start)
    assert "g++" in line.removeprefix(start).split()
