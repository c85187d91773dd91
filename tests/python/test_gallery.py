"""The gallery's page, script and pictures agree."""

from __future__ import annotations

import re
import runpy
import sys
from pathlib import Path

import numpy as np
import pytest

import pbfluids as pbf

ROOT = Path(__file__).resolve().parents[2]
PAGE = (ROOT / "docs" / "gallery.md").read_text(encoding="utf-8")


@pytest.fixture(scope="module")
def gallery():
    return runpy.run_path(str(ROOT / "examples" / "gallery.py"))


def test_the_page_shows_each_picture_with_its_command(gallery):
    names = [picture.__name__ for picture in gallery["PICTURES"]]
    assert len(names) >= 10
    assert sorted(re.findall(r"images/gallery/(\w+)\.png", PAGE)) == sorted(names)
    assert sorted(re.findall(r"\| `python examples/gallery\.py (\w+)`", PAGE)) == sorted(names)


def test_no_picture_is_larger_than_a_megabyte():
    pictures = list((ROOT / "docs" / "images" / "gallery").iterdir())
    assert pictures
    assert all(picture.stat().st_size < 1_000_000 for picture in pictures)


@pytest.mark.parametrize("path", sorted((ROOT / "examples" / "scenes").glob("*.toml")), ids=str)
def test_the_scenes_are_sound(path):
    scene = pbf.Scene.load(path)
    assert scene.name == path.stem
    assert scene.description


@pytest.mark.gl
def test_a_picture_is_drawn_from_a_state_that_is_kept(gallery, tmp_path, tiny, monkeypatch):
    state_of = gallery["state_of"]
    monkeypatch.setitem(state_of.__globals__, "CACHE", tmp_path)
    scene = pbf.Scene(tiny | {"render": {"color_by": "speed"}})
    state = state_of(scene, 0.1)
    assert len(list(tmp_path.iterdir())) == 1
    *_, last = scene.frames()
    assert np.array_equal(state["positions"], last.positions)
    again = state_of(scene.replace(style="spheres"), 0.1)
    assert len(list(tmp_path.iterdir())) == 1
    image = gallery["draw"](scene, again, (64, 48))
    assert image.shape == (48, 64, 4)
    assert gallery["beside"](image, image).shape == (48, 132, 4)


def test_a_picture_whose_package_is_missing_is_left_out_and_named(
    gallery, tmp_path, tiny, monkeypatch, capsys
):
    shared = gallery["vtk"].__globals__
    state = {"positions": np.zeros((1, 3), np.float32)}
    monkeypatch.setitem(shared, "state_of", lambda *_: state)
    monkeypatch.setitem(sys.modules, "vtk", None)
    gallery["main"](["vtk"], tmp_path)
    assert "vtk left out: pip install vtk" in capsys.readouterr().err
    assert not list(tmp_path.iterdir())


def volume(mesh):
    """Inside a closed mesh, positive if its triangles are counter-clockwise seen from outside."""
    a, b, c = mesh.vertices.astype(float)[mesh.faces].swapaxes(0, 1)
    return np.einsum("ij,ij->", a, np.cross(b, c)) / 6


def test_a_tube_holds_what_pappus_says_and_faces_outward(gallery):
    t = np.linspace(0, 2 * np.pi, 200, endpoint=False)
    circle = np.stack([2 * np.cos(t), 2 * np.sin(t), 0 * t], axis=1)
    torus = gallery["tube"](circle, radius=0.5, color=(0, 0, 0))
    assert volume(torus) == pytest.approx(2 * np.pi**2 * 2 * 0.5**2, rel=0.01)
    lying = pbf.Mesh(torus.vertices[:, ::-1], torus.faces, torus.color)
    assert volume(lying) < 0


def test_the_studio_s_lamps_are_bright_and_its_floor_is_dark(gallery):
    light = gallery["softboxes"](64)
    assert light.shape == (64, 128, 3)
    assert light.min() > 0
    assert light[48:].max() < 1
    assert light[:32].max() > 10


def test_an_unknown_picture_is_refused_with_the_known_ones(gallery, tmp_path):
    with pytest.raises(SystemExit, match="no picture is called crwn; known: dam_break"):
        gallery["main"](["crwn"], tmp_path)
