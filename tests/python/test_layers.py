"""The check of the dependency picture passes on our sources and sees planted faults."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]


def run_check(root: Path) -> subprocess.CompletedProcess[str]:
    command = [sys.executable, str(ROOT / "scripts" / "check_layers.py"), str(root)]
    return subprocess.run(command, capture_output=True, text=True, check=False)


def planted(tmp_path: Path, name: str, text: str) -> Path:
    path = tmp_path / "cpp" / "pbf" / name
    path.parent.mkdir(parents=True)
    path.write_text(text, encoding="utf-8")
    return tmp_path


def test_our_own_sources_follow_the_picture() -> None:
    result = run_check(ROOT)
    assert result.returncode == 0, result.stdout


@pytest.mark.parametrize(
    ("name", "line", "message"),
    [
        ("core/a.hpp", '#include "pbf/fluid/b.hpp"', "core must not include fluid"),
        ("kernels/a.hpp", '#include "pbf/neighbors/b.hpp"', "kernels must not include neighbors"),
        ("fluid/a.cpp", '#include "pbf/render/b.hpp"', "fluid must not include render"),
        ("fluid/a.cpp", '#include "pbf/scene/b.hpp"', "fluid must not include scene"),
        ("render/a.cpp", '#include "pbf/fluid/b.hpp"', "render must not include fluid"),
        ("gl/a.cpp", '#include "pbf/render/b.hpp"', "gl must not include render"),
        ("fluid/a.cpp", '#include "../core/b.hpp"', "write it as"),
        ("attic/a.cpp", "int a;", "not in the picture"),
        ("fluid/a.cpp", "#pragma omp parallel for", "OpenMP stays in"),
        ("fluid/a.cpp", "#include <omp.h>", "OpenMP stays in"),
        ("core/parallel.hpp", "#pragma omp parallel for reduction(+:s)", "order of the threads"),
        ("scene/a.cpp", "glDrawArrays(mode, 0, 3);", "GL and EGL stay"),
        ("core/a.cpp", "auto format = GL_RGBA8;", "GL and EGL stay"),
        ("neighbors/a.hpp", "#include <unordered_map>", "standard library"),
        ("fluid/a.cpp", "std::abort();", "end the process"),
    ],
)
def test_a_planted_fault_is_reported(tmp_path: Path, name: str, line: str, message: str) -> None:
    result = run_check(planted(tmp_path, name, f"// a comment\n{line}\n"))
    assert result.returncode == 1
    assert message in result.stdout
    assert f"cpp/pbf/{name}" in result.stdout


@pytest.mark.parametrize(
    ("name", "line"),
    [
        ("fluid/a.cpp", '#include "pbf/boundary/b.hpp"'),
        ("render/a.cpp", '#include "pbf/gl/b.hpp"'),
        ("render/a.cpp", "glDrawArrays(mode, 0, 3);"),
        ("core/parallel.hpp", "#pragma omp parallel for num_threads(n)"),
        ("core/a.hpp", "// a GL_ARRAY_BUFFER of vec3 at the same time"),
    ],
)
def test_what_the_picture_allows_is_not_reported(tmp_path: Path, name: str, line: str) -> None:
    result = run_check(planted(tmp_path, name, line))
    assert result.returncode == 0, result.stdout


def test_an_empty_tree_is_a_fault_and_not_a_pass(tmp_path: Path) -> None:
    result = run_check(tmp_path)
    assert result.returncode == 1
    assert "no C++ files" in result.stdout
