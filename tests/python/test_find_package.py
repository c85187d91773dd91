"""What `cmake --install` gives is enough for a project outside the repository."""

from __future__ import annotations

import pytest
from install.cpp_package import ROOT, installed_prefix, run_outside

pytestmark = [pytest.mark.slow, pytest.mark.gl]


def test_an_outside_project_finds_the_package_steps_a_dam_break_and_draws_it(tmp_path):
    output = run_outside(ROOT / "tests" / "install" / "main.cpp", tmp_path)
    assert output.splitlines() == ["drawn", "1000 particles after 0.083 s"]


def test_the_installed_package_names_no_directory_of_the_build():
    texts = [path.read_text() for path in installed_prefix().rglob("*.cmake")]
    assert len(texts) >= 3
    assert not [text for text in texts if str(ROOT / "cpp") in text or "build/release" in text]
