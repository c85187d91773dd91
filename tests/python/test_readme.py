"""The README's snippets do what the README says."""

from __future__ import annotations

import re
import subprocess
import sys

import pytest
from install.cpp_package import ROOT, run_outside

README = (ROOT / "README.md").read_text(encoding="utf-8")


def block(language: str) -> str:
    """Return the only fenced block of the language."""
    (found,) = re.findall(rf"^```{language}\n(.*?)^```$", README, re.DOTALL | re.MULTILINE)
    return found


@pytest.mark.gl
def test_the_python_snippet_simulates_and_renders(tmp_path):
    check = (
        "\nassert image.shape == (360, 640, 4) and image.dtype == 'uint8'"
        "\nassert len(sim) == 6000 and report.max_density_error < 1"
    )
    script = tmp_path / "snippet.py"
    script.write_text(block("python") + check, encoding="utf-8")
    done = subprocess.run(
        [sys.executable, script], cwd=tmp_path, capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stderr
    assert done.stdout.startswith("6000 particles at 0.33 s")


@pytest.mark.slow
def test_the_cpp_snippet_builds_against_the_installed_package(tmp_path):
    source = tmp_path / "snippet.cpp"
    source.write_text(block("cpp"), encoding="utf-8")
    front = float(re.fullmatch(r"the wave is at x = (\S+) m\n", run_outside(source, tmp_path))[1])
    assert 0.4 < front <= 1.2


def test_the_picture_is_there_and_light():
    (picture,) = re.findall(r"!\[[^\]]+\]\(([^)]+)\)", README)
    assert 10_000 < (ROOT / picture).stat().st_size <= 400_000


@pytest.mark.parametrize("target", ["demo", "test"])
def test_the_two_commands_are_targets_of_the_makefile(target):
    assert README.index(f"make {target}") < README.index("![")
    assert re.search(rf"^{target}:", (ROOT / "Makefile").read_text(encoding="utf-8"), re.MULTILINE)
