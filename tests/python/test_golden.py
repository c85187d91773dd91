"""Whole pictures are what they were, by C++ and by shaders, and would be found out if not."""

from __future__ import annotations

import shutil
from pathlib import Path

import numpy as np
import pytest
from PIL import Image
from support import golden

pytestmark = pytest.mark.gl
ROOT = Path(__file__).resolve().parents[2]


@pytest.mark.parametrize("backend", ["cpu", "egl"])
@pytest.mark.parametrize("name", golden.GOLDEN)
def test_a_picture_is_what_it_was(name, backend):
    found = golden.GOLDEN[name].draw(backend)
    assert golden.complaint(name, found) is None


def test_the_pictures_that_are_kept_are_few_and_small():
    files = sorted(path.stem for path in golden.FOLDER.iterdir())
    assert files == sorted(golden.GOLDEN)
    assert all(path.stat().st_size < 40_000 for path in golden.FOLDER.iterdir())


def test_a_picture_that_has_changed_is_shown_and_said_where(tmp_path):
    changed = golden.kept("water")
    changed[20:60, 30:50, 1] += 100
    complaint = golden.complaint("water", changed, tmp_path)
    assert f"{40 * 20 / changed[..., 0].size:.2%} of the pixels are off" in complaint
    assert "all within rows 20 to 59, columns 30 to 49" in complaint
    assert "python scripts/update_golden.py water" in complaint
    with Image.open(tmp_path / "water.png") as shown:
        expected, found, apart = np.split(np.asarray(shown), 3, axis=1)
    assert np.array_equal(expected, golden.kept("water"))
    assert np.array_equal(found, changed)
    assert np.array_equal(apart[..., 0] > 0, (changed != expected).any(axis=2))


def test_a_slight_change_everywhere_is_one_too(tmp_path):
    changed = np.clip(golden.kept("water").astype(int) + 1, 0, 255).astype(np.uint8)
    assert "0.00% of the pixels" in golden.complaint("water", changed, tmp_path)


@pytest.mark.parametrize(
    ("shader", "defect", "seen_in"),
    [
        ("normal", "o_normal.xy *= -1.0;", ["water", "transparent", "mesh", "light", "filters"]),
        ("spheres", "o_surface.xyz *= -1.0;", ["spheres"]),
        ("opaque_meshes", "o_color.rgb *= 0.8;", ["mesh"]),
    ],
)
def test_a_defect_in_a_shader_is_found(tmp_path, monkeypatch, shader, defect, seen_in):
    shutil.copytree(ROOT / "glsl", tmp_path / "glsl")
    path = tmp_path / "glsl" / f"{shader}.frag"
    sound = path.read_text(encoding="utf-8").replace("void main()", "void sound()")
    path.write_text(f"{sound}\nvoid main() {{ sound(); {defect} }}\n", encoding="utf-8")
    monkeypatch.setenv("PBF_GLSL_DIR", str(tmp_path / "glsl"))
    pictures = {name: picture.draw("egl") for name, picture in golden.GOLDEN.items()}
    complaints = [name for name in pictures if golden.complaint(name, pictures[name], tmp_path)]
    assert complaints == seen_in
