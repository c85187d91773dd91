"""Meshes and environment maps from files: what is read, how it is drawn, and what is refused."""

from __future__ import annotations

import struct
import sys

import numpy as np
import pytest
from PIL import Image

import pbfluids as pbf
from pbfluids import errors, toml
from pbfluids.run import draw, simulate

trimesh = pytest.importorskip("trimesh")
oiio = pytest.importorskip("OpenImageIO")

# A tetrahedron, its triangles counter-clockwise seen from outside.
CORNERS = np.array([(0, 0, 0), (1, 0, 0), (0, 2, 0), (0, 0, 3)], float)
TRIANGLES = np.array([(0, 2, 1), (0, 1, 3), (0, 3, 2), (1, 2, 3)])


def write_obj(path, corners=CORNERS, triangles=TRIANGLES):
    lines = [f"v {x} {y} {z}" for x, y, z in corners]
    lines += ["f {} {} {}".format(*(row + 1)) for row in triangles]
    path.write_text("\n".join(lines) + "\n", encoding="utf-8")


def write_stl(path):
    rows = [struct.pack("<12fH", 0, 0, 0, *CORNERS[row].ravel(), 0) for row in TRIANGLES]
    path.write_bytes(bytes(80) + struct.pack("<I", len(rows)) + b"".join(rows))


def write_ply(path):
    lines = ["ply", "format ascii 1.0", "element vertex 4"]
    lines += [f"property float {axis}" for axis in "xyz"]
    lines += ["element face 4", "property list uchar int vertex_indices", "end_header"]
    lines += ["{} {} {}".format(*row) for row in CORNERS]
    lines += ["3 {} {} {}".format(*row) for row in TRIANGLES]
    path.write_text("\n".join(lines) + "\n", encoding="utf-8")


@pytest.mark.parametrize(
    ("suffix", "write"), [("obj", write_obj), ("stl", write_stl), ("ply", write_ply)]
)
def test_a_mesh_is_read_from_each_format(tmp_path, suffix, write):
    path = tmp_path / f"shape.{suffix}"
    write(path)
    mesh = pbf.read_mesh(path, color=(0.1, 0.2, 0.3))
    found = mesh.vertices[mesh.faces]
    np.testing.assert_array_equal(found, CORNERS[TRIANGLES])
    assert mesh.color == pytest.approx((0.1, 0.2, 0.3))
    assert pbf.read_mesh(str(path)).color == pbf.Mesh(CORNERS, TRIANGLES).color


def test_a_mesh_is_scaled_then_turned_about_x_y_z_then_moved(tmp_path):
    write_obj(tmp_path / "shape.obj")
    about_x = pbf.read_mesh(tmp_path / "shape.obj", rotation=(90, 0, 0))
    np.testing.assert_allclose(about_x.vertices[2:], [(0, 0, 2), (0, -3, 0)], atol=1e-6)
    # x → z after 90° about −y; 90° about x first leaves it.
    placed = pbf.read_mesh(
        tmp_path / "shape.obj", position=(10, 20, 30), scale=0.5, rotation=(90, -90, 180)
    )
    expected = [(0, 0, 0), (0, 0, 0.5), (1, 0, 0), (0, 1.5, 0)]
    np.testing.assert_allclose(placed.vertices, np.add(expected, (10, 20, 30)), atol=1e-5)


@pytest.mark.parametrize(
    ("name", "content", "match"),
    [
        ("gone.obj", None, "there is no such file"),
        ("empty.obj", "", "holds no triangles"),
        ("points.obj", "v 0 0 0\nv 1 0 0\n", "holds no triangles"),
        ("text.ply", "water", "trimesh finds no mesh in it"),
        ("text.stl", "water", "holds no triangles|trimesh finds no mesh"),
        ("what.water", "water", "trimesh finds no mesh in it"),
        ("far.obj", "v 0 0 0\nv 1 0 0\nf 1 2 9\n", "trimesh finds no mesh in it"),
        (
            "nan.obj",
            "v 0 0 nan\nv 1 0 0\nv 0 1 0\nf 1 2 3\n",
            "vertices: .* in row 0; must be finite",
        ),
    ],
)
def test_what_is_no_mesh_is_refused_by_its_name(tmp_path, name, content, match):
    if content is not None:
        (tmp_path / name).write_text(content, encoding="utf-8")
    with pytest.raises(errors.InvalidParameter, match=rf"{name}: {match}"):
        pbf.read_mesh(tmp_path / name)


def test_a_closed_mesh_turned_inside_out_is_refused_and_an_open_one_is_not(tmp_path):
    write_obj(tmp_path / "shape.obj", triangles=TRIANGLES[:, ::-1])
    with pytest.raises(errors.InvalidParameter, match=r"shape\.obj: is inside out"):
        pbf.read_mesh(tmp_path / "shape.obj")
    write_obj(tmp_path / "open.obj", triangles=TRIANGLES[:3, ::-1])
    assert len(pbf.read_mesh(tmp_path / "open.obj").faces) == 3


@pytest.mark.parametrize(
    ("placing", "match"),
    [
        ({"scale": 0}, "scale = 0 m: must be > 0"),
        ({"scale": np.nan}, "scale = nan: must be a finite number"),
        ({"position": (0, 0)}, r"position = \(0, 0\): must be three finite numbers"),
        ({"rotation": (0, 0, np.inf)}, "rotation = .*: must be three finite numbers"),
        ({"color": (0, 0, 2)}, r"Mesh\.color = \(0, 0, 2\)"),
    ],
)
def test_an_impossible_place_is_refused(tmp_path, placing, match):
    write_obj(tmp_path / "shape.obj")
    with pytest.raises(errors.InvalidParameter, match=match):
        pbf.read_mesh(tmp_path / "shape.obj", **placing)


def test_a_place_that_is_no_number_is_refused(tmp_path):
    write_obj(tmp_path / "shape.obj")
    for placing in ({"scale": "large"}, {"position": {}}, {"rotation": "north"}):
        with pytest.raises(errors.WrongType, match="must be real numbers"):
            pbf.read_mesh(tmp_path / "shape.obj", **placing)


def write_light(path, light, kind="float", channels=("R", "G", "B")):
    spec = oiio.ImageSpec(light.shape[1], light.shape[0], light.shape[2], kind)
    spec.channelnames = channels
    image = oiio.ImageOutput.create(str(path))
    assert image.open(str(path), spec), image.geterror()
    assert image.write_image(np.ascontiguousarray(light, np.float32))
    image.close()


@pytest.fixture
def light():
    """Light between 1e-3 and 1e4, no two pixels alike."""
    rng = np.random.default_rng(7)
    return (10 ** rng.uniform(-3, 4, (16, 32, 1)) * rng.uniform(0.2, 1, (16, 32, 3))).astype(
        np.float32
    )


# RGBE shares an exponent among the channels: steps are 1/256 of the largest, at worst 1/128.
@pytest.mark.parametrize(("name", "error"), [("sky.exr", 0), ("sky.hdr", 1 / 128)])
def test_light_comes_back_as_it_was_written(tmp_path, light, name, error):
    write_light(tmp_path / name, light)
    found = pbf.read_environment_map(tmp_path / name)
    assert found.dtype == np.float32
    assert found.shape == light.shape
    assert np.all(np.abs(found - light) <= error * light.max(axis=2, keepdims=True))


def test_a_flat_radiance_file_is_read_by_its_formula(tmp_path):
    # (m/256) · 2^(e−128), row by row.
    pixels = np.array([[(128, 64, 32, 129), (255, 1, 0, 137)]], np.uint8)
    head = b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 2\n"
    (tmp_path / "sky.hdr").write_bytes(head + pixels.tobytes())
    found = pbf.read_environment_map(tmp_path / "sky.hdr")
    expected = [[(1, 0.5, 0.25), (510, 2, 0)]]
    np.testing.assert_allclose(found, expected, rtol=0.01, atol=0.01)


def test_channels_are_taken_by_their_names(tmp_path, light):
    layered = np.concatenate([light, light[..., :1] * 0 + 0.5], axis=2)
    write_light(tmp_path / "sky.exr", layered, channels=("A", "B", "G", "R"))
    found = pbf.read_environment_map(tmp_path / "sky.exr")
    np.testing.assert_array_equal(found, layered[..., [3, 2, 1]])


@pytest.mark.parametrize(
    ("name", "match"),
    [
        ("gone.hdr", "there is no such file"),
        ("text.hdr", "no picture of light"),
        ("short.hdr", "is damaged"),
        ("screen.png", "holds uint8, which are colors for a screen; light takes"),
        ("gray.exr", "has the channels Y; must have R, G and B"),
    ],
)
def test_what_is_no_light_is_refused_by_its_name(tmp_path, light, name, match):
    (tmp_path / "text.hdr").write_text("water", encoding="utf-8")
    write_light(tmp_path / "sky.hdr", light)
    (tmp_path / "short.hdr").write_bytes((tmp_path / "sky.hdr").read_bytes()[:200])
    Image.new("RGB", (4, 2)).save(tmp_path / "screen.png")
    write_light(tmp_path / "gray.exr", light[..., :1], channels=("Y",))
    with pytest.raises(errors.InvalidParameter, match=f"{name}: {match}"):
        pbf.read_environment_map(tmp_path / name)


@pytest.mark.parametrize(
    ("package", "read", "cure"),
    [
        ("trimesh", pbf.read_mesh, r"meshes need trimesh: pip install 'pbfluids\[meshes\]'"),
        (
            "OpenImageIO",
            pbf.read_environment_map,
            r"environment maps need OpenImageIO: pip install 'pbfluids\[hdr\]'",
        ),
    ],
)
def test_a_missing_package_is_named_with_the_command(monkeypatch, package, read, cure):
    monkeypatch.setitem(sys.modules, package, None)
    with pytest.raises(errors.MissingExtra, match=cure):
        read(__file__)


@pytest.fixture
def dressed(tiny, tmp_path):
    """The tiny scene's file with a plate before the fluid and light of three colors."""
    plate = [(-0.1, -0.1, 0), (0.1, -0.1, 0), (0.1, 0.1, 0), (-0.1, 0.1, 0)]
    write_obj(tmp_path / "plate.obj", plate, np.array([(0, 1, 2), (0, 2, 3)]))
    sky = np.concatenate([np.full((8, 32, 3), c) for c in ((0.2, 0.4, 0.9), (0.6, 0.3, 0.1))])
    write_light(tmp_path / "sky.hdr", sky)
    tiny["meshes"] = [
        {"file": "plate.obj", "position": [0.2, 0.2, 0.3], "color": [0.7, 0.1, 0.1]},
        {"file": "plate.obj", "position": [0.2, 0.2, -0.1], "scale": 1.5, "rotation": [0, 0, 45]},
    ]
    tiny["camera"] = {"eye": [0.2, 0.2, 1.0], "target": [0.2, 0.2, 0.0]}
    tiny["render"] = {"environment_map": "sky.hdr", "floor": False}
    path = tmp_path / "dressed.toml"
    path.write_text(toml.dumps(tiny), encoding="utf-8")
    return path


def picture_of(path):
    with Image.open(path) as opened:
        return np.asarray(opened).copy()


@pytest.mark.gl
def test_a_scene_s_files_are_drawn_as_python_draws_them_and_drawn_again(dressed, tmp_path):
    scene = pbf.Scene.load(dressed)
    run = simulate(scene, tmp_path / "run", size=(96, 72))
    *_, last = scene.frames()
    meshes, light = scene.meshes(), pbf.read_environment_map(tmp_path / "sky.hdr")
    assert [len(mesh.faces) for mesh in meshes] == [2, 2]
    with pbf.Renderer(96, 72, environment_map=light) as renderer:
        params, view = scene.render_params, scene.camera
        expected = renderer.render(last.positions, view, params, meshes=meshes)
        bare = renderer.render(last.positions, view, params)
    file = run.path / "images/frame_00002.png"
    found = picture_of(file)
    assert np.array_equal(found, expected[..., : found.shape[2]])
    # The plate 0.7 m ahead of the eye hides what is behind: 0.2 m of 0.58 m, 25 of 72 rows.
    assert (found[36, 48] != bare[36, 48, : found.shape[2]]).any()
    red = found[30:42, 42:54, :3].astype(int)
    assert np.all(red[..., 0] > 2 * red[..., 1])
    # The sky is the map's: linear (0.2, 0.4, 0.9) above the horizon, (0.6, 0.3, 0.1) below.
    assert np.all(found[0, 0, :3].argsort() == [0, 1, 2])
    assert np.all(found[-1, 0, :3].argsort() == [2, 1, 0])
    draw(run.path)
    assert np.array_equal(picture_of(file), found)
    draw(run.path, overrides={"meshes": [], "environment_map": None, "background": "plain"})
    assert not np.array_equal(picture_of(file), found)


@pytest.mark.gl
def test_a_run_whose_mesh_has_gone_is_drawn_without_it_or_not_at_all(dressed, tmp_path):
    run = simulate(pbf.Scene.load(dressed), tmp_path / "run", count=1, size=(32, 24))
    before = (run.path / "images/frame_00000.png").read_bytes()
    (tmp_path / "plate.obj").unlink()
    with pytest.raises(errors.SceneError, match=r"meshes\[0\]\.file = .*: there is no such file"):
        draw(run.path)
    assert (run.path / "images/frame_00000.png").read_bytes() == before
    draw(run.path, overrides={"meshes": []})
    assert (run.path / "images/frame_00000.png").read_bytes() != before


def test_a_mesh_that_cannot_be_read_leaves_an_earlier_run_as_it_was(dressed, tmp_path):
    simulate(pbf.Scene.load(dressed), tmp_path / "run", count=2, render=False)
    (tmp_path / "plate.obj").write_text("", encoding="utf-8")
    with pytest.raises(errors.InvalidParameter, match=r"plate\.obj: holds no triangles"):
        simulate(pbf.Scene.load(dressed), tmp_path / "run", count=2, size=(32, 24))
    assert len(list((tmp_path / "run" / "particles").iterdir())) == 2
