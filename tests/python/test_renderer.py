"""The renderer from Python: closed forms of the layers, its life, and what it refuses."""

from __future__ import annotations

import shutil
import threading
from pathlib import Path

import numpy as np
import pytest
from support.process import run_python

import pbfluids as pbf
from pbfluids import errors

pytestmark = pytest.mark.gl

GLSL = Path(__file__).parents[2] / "glsl"
ALONG_Z = {"eye": (0, 0, 0), "target": (0, 0, -1)}


def rays(camera, width=160, height=120):
    """Slopes x/depth, y/depth of the pixels' rays; row 0 on top."""
    half = np.tan(np.radians(camera.fov_y) / 2)
    x = (2 * (np.arange(width) + 0.5) / width - 1) * half * width / height
    y = -(2 * (np.arange(height) + 0.5) / height - 1) * half
    return np.meshgrid(x, y)


@pytest.mark.parametrize("fov", [20, 60, 100])
@pytest.mark.parametrize("off_axis", [0.0, 0.7])
def test_a_sphere_has_the_depth_chord_and_normal_of_a_sphere(renderer, fov, off_axis):
    camera = pbf.Camera(**ALONG_Z, fov_y=fov)
    half = np.tan(np.radians(fov) / 2)
    center = np.array([off_axis * half * 3, -off_axis * half * 2.4, -3.0])
    radius = 0.5 * half
    params = pbf.RenderParams(radius=radius, smoothing_iterations=0, thickness_iterations=0)
    layers = renderer.layers([center], camera, params)
    center, radius = np.float32(center).astype(float), float(np.float32(radius))

    x, y = rays(camera)
    direction = np.stack([x, y, -np.ones_like(x)], axis=-1)
    length2 = (direction**2).sum(axis=-1)
    middle = direction @ center / length2
    discriminant = radius**2 - ((center - middle[..., None] * direction) ** 2).sum(axis=-1)
    inside, outside = discriminant > 0.02 * radius**2, discriminant < -0.02 * radius**2
    assert inside.sum() > 100

    half_chord = np.sqrt(np.maximum(discriminant, 0))
    depth = middle - half_chord / np.sqrt(length2)
    assert layers["depth"][inside] == pytest.approx(depth[inside], rel=1e-5)
    assert layers["thickness"][inside] == pytest.approx(2 * half_chord[inside], rel=1e-4)
    assert not layers["depth"][outside].any()
    assert not layers["thickness"][outside].any()

    normal = (depth[..., None] * direction - center) / radius
    well_inside = discriminant > 0.5 * radius**2
    cosine = (layers["normal"] * normal).sum(axis=-1)[well_inside]
    assert np.degrees(np.arccos(np.clip(cosine, -1, 1))).max() < 1.5  # of pixel-wide differences


@pytest.mark.parametrize("pixels", [4, 12, 40])
def test_at_its_outline_a_drop_has_the_normal_of_its_sphere(renderer, pixels):
    camera = pbf.Camera(**ALONG_Z, fov_y=40)
    center = np.float32([0.11, -0.07, -2.0]).astype(float)
    radius = pixels * 2 * np.tan(np.radians(20)) / 60
    params = pbf.RenderParams(radius=1.5 * radius, drop_radius=radius)
    layers = renderer.layers([center], camera, params)
    x, y = rays(camera)
    depth = layers["depth"].astype(float)
    normal = (np.stack([x, y, -np.ones_like(x)], axis=-1) * depth[..., None] - center) / radius
    seen = np.pad(depth > 0, 1)
    sides = [seen[1:-1, :-2], seen[1:-1, 2:], seen[:-2, 1:-1], seen[2:, 1:-1]]
    outline = (depth > 0) & ~np.logical_and.reduce(sides)
    assert outline.sum() > 4 * pixels
    cosine = (layers["normal"] * normal).sum(axis=-1)[outline]
    assert np.degrees(np.arccos(np.clip(cosine, -1, 1))).max() < 0.5  # 18 by differences


def test_a_sphere_in_parallel_view(renderer):
    camera = pbf.Camera(**ALONG_Z, orthographic=True, height=2.4)  # a pixel is 0.02 m
    layers = renderer.layers([[0.3, -0.2, -5]], camera, pbf.RenderParams(radius=0.4))
    x, y = np.meshgrid((np.arange(160) - 79.5) * 0.02, -(np.arange(120) - 59.5) * 0.02)
    discriminant = 0.16 - (x - 0.3) ** 2 - (y + 0.2) ** 2
    inside = discriminant > 0.003
    assert layers["depth"][inside] == pytest.approx(5 - np.sqrt(discriminant[inside]), rel=1e-5)
    assert layers["thickness"][inside] == pytest.approx(2 * np.sqrt(discriminant[inside]), rel=1e-4)


def test_of_two_spheres_the_nearer_is_seen_and_the_chords_add(renderer):
    camera = pbf.Camera(**ALONG_Z, fov_y=40)
    params = pbf.RenderParams(radius=0.3)
    first, second = [[0, 0, -3]], [[0.1, 0.05, -3.2]]
    one, two = (renderer.layers(x, camera, params) for x in (first, second))
    both = renderer.layers(first + second, camera, params)
    far = np.where(two["depth"] == 0, np.inf, two["depth"])
    near = np.where(one["depth"] == 0, np.inf, one["depth"])
    nearest = np.minimum(near, far)
    assert np.array_equal(both["depth"], np.where(np.isinf(nearest), 0, nearest))
    assert np.allclose(both["thickness"], one["thickness"] + two["thickness"], rtol=1e-6)


@pytest.mark.parametrize("scale", [1, 1.5, 2, 3])
def test_thickness_holds_the_volume_of_the_fluid_whatever_the_radius(renderer, scale):
    # No lattice: its spheres would all lie alike on the pixels and make the same error.
    cloud = np.random.default_rng(3).uniform((-0.5, -0.4, -1.5), (0.5, 0.4, -0.9), (2000, 3))
    camera = pbf.Camera(**ALONG_Z, orthographic=True, height=1.2)
    params = pbf.RenderParams(radius=0.025 * scale, particle_volume=0.05**3)
    layers = renderer.layers(cloud, camera, params)
    volume = layers["thickness"].sum(dtype=float) * 0.01**2
    assert volume == pytest.approx(len(cloud) * 0.05**3, rel=0.01)


@pytest.mark.parametrize("smoothing", ["bilateral", "gaussian"])
def test_a_sheet_of_particles_becomes_a_smooth_plane(smoothing, backend):
    x, y = np.meshgrid(np.arange(-60, 61) * 0.02, np.arange(-60, 61) * 0.02)
    sheet = np.stack([x, y, -2 + 0.5 * y], axis=-1).reshape(-1, 3)
    camera = pbf.Camera(**ALONG_Z, fov_y=30)
    with pbf.Renderer(320, 240, backend=backend) as large:
        layers = large.layers(sheet, camera, pbf.RenderParams(radius=0.02, smoothing=smoothing))
    normal = layers["normal"][20:-20, 20:-20]
    expected = np.array([0, -0.5, 1]) / np.hypot(1, 0.5)
    angles = np.degrees(np.arccos(np.clip(normal @ expected, -1, 1)))
    assert angles.mean() < 1.0
    assert angles.max() < 5.0


def test_no_particles_give_the_background(renderer):
    camera = pbf.Camera(**ALONG_Z)
    params = pbf.RenderParams(background="plain", background_color=(1, 0, 0), floor=False)
    image = renderer.render(np.zeros((0, 3)), camera, params)
    assert image.shape == (120, 160, 4)
    assert image.dtype == np.uint8
    # Pure red comes out at the shoulder of the tone curve: 0.9, encoded.
    assert np.all(image == image[0, 0])
    assert image[0, 0].tolist()[1:] == [0, 0, 255]
    layers = renderer.layers(np.zeros((0, 3)), camera, params)
    assert all(not layer.any() for layer in layers.values())


def test_row_0_is_the_top(renderer):
    params = pbf.RenderParams(radius=0.1)
    layers = renderer.layers([[0, 0.6, -2]], pbf.Camera(**ALONG_Z), params)
    assert layers["depth"][:60].any()
    assert not layers["depth"][60:].any()


def test_particles_behind_the_camera_are_not_seen(renderer):
    camera = pbf.Camera(**ALONG_Z)
    layers = renderer.layers([[0, 0, 2], [0, 0, 0.51]], camera, pbf.RenderParams(radius=0.5))
    assert all(not layer.any() for layer in layers.values())


@pytest.mark.parametrize("center", [(0, 0, -0.5), (0.3, 0.1, -0.45), (0, 0, 0), (0, 0.4, 0.1)])
def test_what_crosses_the_near_plane_is_cut_there(renderer, center):
    camera = pbf.Camera(**ALONG_Z, near=0.2, far=10)
    params = pbf.RenderParams(radius=0.5, smoothing_iterations=0)
    layers = renderer.layers([center], camera, params)
    x, y = rays(camera)
    length2 = x * x + y * y + 1
    middle = (x * center[0] + y * center[1] - center[2]) / length2
    miss2 = np.dot(center, center) - middle**2 * length2
    half_depth = np.sqrt(np.maximum(0.25 - miss2, 0) / length2)
    chord = (np.maximum(middle + half_depth - np.maximum(middle - half_depth, 0.2), 0)) * np.sqrt(
        length2
    )
    sure = np.abs(0.25 - miss2) > 0.01
    chord[miss2 > 0.25] = 0
    assert layers["thickness"][sure] == pytest.approx(chord[sure], rel=1e-3, abs=1e-4)
    front = np.where((middle - half_depth >= 0.2) & (miss2 < 0.25), middle - half_depth, 0)
    sure &= np.abs(middle - half_depth - 0.2) > 1e-3
    assert layers["depth"][sure] == pytest.approx(front[sure], rel=1e-4, abs=1e-6)
    assert np.isfinite(layers["normal"]).all()


def test_the_same_call_gives_the_same_bits(renderer):
    cloud = np.random.default_rng(1).uniform(-0.5, 0.5, (3000, 3)) - [0, 0, 2]
    camera, params = pbf.Camera(**ALONG_Z), pbf.RenderParams(radius=0.05)
    assert np.array_equal(
        renderer.render(cloud, camera, params), renderer.render(cloud, camera, params)
    )


def splash():
    """Return a body of fluid, a sheet and drops in front of it, and how they are drawn."""
    random = np.random.default_rng(5)
    body = np.stack(np.meshgrid(*[np.arange(20)] * 3), axis=-1).reshape(-1, 3) * 0.02
    spray = random.uniform((-0.2, 0.0, 0.0), (0.6, 0.7, 0.7), (600, 3))
    cloud = np.concatenate([body + random.uniform(-0.004, 0.004, body.shape), spray])
    params = pbf.RenderParams(radius=0.024, drop_radius=0.0124, particle_volume=0.02**3)
    return cloud, pbf.Camera(eye=(1.0, 0.6, 1.1), target=(0.2, 0.2, 0.2)), params


@pytest.mark.parametrize("orthographic", [False, True])
def test_all_backends_find_the_same_layers(orthographic):
    cloud, camera, params = splash()
    camera.orthographic, camera.height = orthographic, 0.8
    found = {}
    for backend in ("egl", "cpu"):
        with pbf.Renderer(320, 240, backend=backend) as renderer:
            found[backend] = renderer.layers(cloud, camera, params)
    expected, other = found["egl"], found["cpu"]
    assert (expected["depth"] > 0).sum() > 20000
    # At the rim of a sphere a rounding decides who is seen.
    seen = (other["depth"] > 0) == (expected["depth"] > 0)
    assert seen.mean() > 0.9999
    for name, tolerance in {
        "depth": 2e-5,
        "thickness": 4e-5,
        "depth_smooth": 2e-5,
        "thickness_smooth": 2e-5,
        "normal": 2e-3,
    }.items():
        difference = np.abs(other[name] - expected[name])
        assert (difference > tolerance).mean() < 1e-4, name


def test_at_the_outline_of_a_ball_of_fluid_normals_are_the_balls(backend):
    d = 0.02
    lattice = np.stack(np.meshgrid(*[np.arange(-7, 8) * d] * 3), axis=-1).reshape(-1, 3)
    ball = lattice + np.random.default_rng(2).uniform(-0.2 * d, 0.2 * d, lattice.shape)
    ball = ball[np.linalg.norm(ball, axis=1) < 0.11]
    camera = pbf.Camera(eye=(0, 0, 5), target=(0, 0, 0), orthographic=True, height=0.3)
    params = pbf.RenderParams(radius=d, drop_radius=0.62 * d, particle_volume=d**3)
    with pbf.Renderer(240, 240, backend=backend) as renderer:
        layers = renderer.layers(ball, camera, params)
    fluid = layers["depth"] > 0
    inner = fluid.copy()
    for shift, axis in ((1, 0), (-1, 0), (1, 1), (-1, 1)):
        inner &= np.roll(fluid, shift, axis)
    at = (np.arange(240) + 0.5) * (0.3 / 240) - 0.15
    out = np.stack(np.meshgrid(at, -at), axis=-1)[fluid & ~inner]
    radius = np.linalg.norm(out, axis=1)
    largest = radius.max()  # of the ball with its spheres
    normal = np.column_stack([out, np.sqrt(largest**2 - radius**2)]) / largest
    cosine = (layers["normal"][fluid & ~inner] * normal).sum(axis=1)
    assert len(radius) > 400
    assert np.degrees(np.arccos(np.clip(cosine, -1, 1))).mean() < 11  # 21 by differences


def test_a_face_across_the_view_has_normals_up_to_its_edge(backend):
    face = np.stack(np.meshgrid(*[np.arange(12) * 0.02] * 3), axis=-1).reshape(-1, 3)
    camera = pbf.Camera(eye=(0.11, 0.11, 3), target=(0.11, 0.11, 0), orthographic=True, height=0.4)
    params = pbf.RenderParams(radius=0.024, drop_radius=0.0124, particle_volume=0.02**3)
    with pbf.Renderer(160, 160, backend=backend) as renderer:
        layers = renderer.layers(face, camera, params)
    lengths = np.linalg.norm(layers["normal"][layers["depth"] > 0], axis=1)
    assert lengths == pytest.approx(1, abs=1e-4)


def test_without_opengl_there_are_pictures():
    code = """
import pbfluids as pbf
with pbf.Renderer(32, 24, backend="cpu", timed=True) as r:
    print(r.render([[0, 0, 0]], pbf.Camera()).shape, list(r.report["milliseconds"]))
    print(r)
"""
    done = run_python(code, __EGL_VENDOR_LIBRARY_DIRS="/nowhere", LIBGL_DRIVERS_PATH="/nowhere")
    assert done.returncode == 0, done.stderr
    assert "(24, 32, 4)" in done.stdout
    assert "composite" in done.stdout
    assert "no OpenGL" in done.stdout


def test_unknown_backends_are_refused():
    with pytest.raises(errors.InvalidParameter, match='backend = "gpu": must be "egl"'):
        pbf.Renderer(16, 16, backend="gpu")


@pytest.mark.parametrize("size", [(0, 8), (8, 20000)])
def test_impossible_sizes_are_refused_without_opengl_as_well(size):
    with pytest.raises(errors.InvalidParameter, match="pixels: must be at"):
        pbf.Renderer(*size, backend="cpu")


def test_strange_clouds_end_no_process(backend):
    camera = pbf.Camera(**ALONG_Z)
    everywhere = np.random.default_rng(1).normal(size=(300, 3)) * 1e3
    with pbf.Renderer(1, 1, backend=backend) as small:
        for cloud in (np.zeros((0, 3)), np.zeros((5, 3)), everywhere, everywhere * 1e32):
            for radius in (1e-6, 1.0, 9e5):
                params = pbf.RenderParams(radius=radius, drop_radius=radius / 2)
                small.layers(cloud, camera, params)
    with pbf.Renderer(700, 300, backend=backend) as wide:
        layers = wide.layers([[0, 0, -5]] * 50, camera, pbf.RenderParams(radius=4.9))
        assert (layers["depth"] > 0).all()


def test_twice_the_resolution_shows_the_same_surface(backend):
    block = pbf.block((-0.3, -0.3, -2.3), (0.3, 0.3, -1.7), spacing=0.04)
    camera, params = pbf.Camera(**ALONG_Z), pbf.RenderParams(radius=0.04)
    with (
        pbf.Renderer(160, 120, backend=backend) as small,
        pbf.Renderer(320, 240, backend=backend) as large,
    ):
        one = small.layers(block, camera, params)["depth_smooth"]
        two = large.layers(block, camera, params)["depth_smooth"]
    two = two.reshape(120, 2, 160, 2).transpose(0, 2, 1, 3).reshape(120, 160, 4)
    seen = (one > 0) & (two > 0).all(axis=-1)
    assert seen.sum() > 1000
    assert np.median(np.abs(two.mean(axis=-1) - one)[seen]) < 0.04 * 0.04


def test_the_first_opengl_version_that_is_enough_draws_the_same():
    code = """
import numpy as np, pbfluids as pbf
cloud = np.random.default_rng(1).uniform(-0.5, 0.5, (500, 3)) - [0, 0, 2]
camera = pbf.Camera(eye=(0, 0, 0), target=(0, 0, -1))
with pbf.Renderer(64, 48, backend="egl") as r:
    print(r.info["version"].split()[0])
    print(int(r.render(cloud, camera, pbf.RenderParams(radius=0.05)).astype(int).sum()))
"""
    version = {"MESA_GL_VERSION_OVERRIDE": "3.3", "MESA_GLSL_VERSION_OVERRIDE": "330"}
    floor, best = run_python(code, **version), run_python(code)
    assert floor.returncode == 0, floor.stderr
    assert floor.stdout.split()[0] == "3.3"
    assert best.stdout.split()[0] > "3.3"
    assert floor.stdout.split()[1] == best.stdout.split()[1]


def test_a_report_counts_particles_and_times_passes_when_asked(renderer, backend):
    camera = pbf.Camera(**ALONG_Z)
    renderer.render([[0, 0, -1]], camera)
    assert renderer.report == {"particles": 1, "milliseconds": {}}
    with pbf.Renderer(16, 16, timed=True, backend=backend) as timed:
        timed.render([[0, 0, -1]], camera)
        passes = set(timed.report["milliseconds"])
    assert passes == {
        *("crowding", "sphere_depth", "depth_smooth", "back_smooth"),
        *("thickness_smooth", "normal", "shadow", "composite"),
        *(("backdrop",) if backend == "cpu" else ("upload", "read_back")),
    }
    assert "OpenGL" in renderer.description
    assert set(renderer.info) == {"renderer", "vendor", "version", "platform", "choice"}


def test_close_is_final_and_may_come_twice(backend):
    renderer = pbf.Renderer(16, 16, backend=backend)
    renderer.close()
    renderer.close()
    assert renderer.closed
    with pytest.raises(errors.GlError, match="closed; make a new one"):
        renderer.render([[0, 0, 0]], pbf.Camera())


def test_two_renderers_do_not_disturb_each_other(backend):
    camera = pbf.Camera(**ALONG_Z)
    cloud = [[0, 0, -1]]
    one, two = (pbf.Renderer(*size, backend=backend) for size in ((32, 32), (48, 16)))
    first = one.render(cloud, camera)
    assert two.render(cloud, camera).shape == (16, 48, 4)
    two.close()
    assert np.array_equal(one.render(cloud, camera), first)
    one.close()


def test_threads_may_share_a_renderer_or_have_their_own(renderer, backend):
    camera, cloud = pbf.Camera(**ALONG_Z), [[0, 0, -1]]
    expected = renderer.render(cloud, camera)
    images = []

    def draw(own):
        if own:
            with pbf.Renderer(160, 120, backend=backend) as mine:
                images.append(mine.render(cloud, camera))
        else:
            images.append(renderer.render(cloud, camera))

    threads = [threading.Thread(target=draw, args=(k % 2 == 0,)) for k in range(6)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert len(images) == 6
    assert all(np.array_equal(image, expected) for image in images)


def test_a_broken_shader_is_reported_with_file_and_line(tmp_path, monkeypatch):
    folder = tmp_path / "glsl"
    shutil.copytree(GLSL, folder)
    path = folder / "normal.frag"
    lines = path.read_text(encoding="utf-8").splitlines()
    number = lines.index("void main() {") + 2
    lines.insert(number - 1, "  float x = undeclared;")
    path.write_text("\n".join(lines), encoding="utf-8")
    monkeypatch.setenv("PBF_GLSL_DIR", str(folder))
    with pytest.raises(errors.GlError, match=rf"normal\.frag:{number}: (.|\n)*undeclared"):
        pbf.Renderer(16, 16, backend="egl")
    monkeypatch.setenv("PBF_GLSL_DIR", "/nowhere")
    with pytest.raises(errors.GlError, match="PBF_GLSL_DIR = /nowhere"):
        pbf.Renderer(16, 16, backend="egl")


@pytest.mark.parametrize("size", [(0, 10), (10, -1), (10, 10**6)])
def test_impossible_sizes_are_refused(size, backend):
    with pytest.raises(errors.InvalidParameter, match=r"(width|height) = -?[0-9]+ pixels: "):
        pbf.Renderer(*size, backend=backend)


@pytest.mark.parametrize(
    ("positions", "error", "match"),
    [
        (np.zeros((3, 2)), errors.InvalidParameter, r"positions: expected shape \(n, 3\)"),
        (np.zeros(3), errors.InvalidParameter, r"positions: expected shape \(n, 3\)"),
        ([[0, np.nan, 0]], errors.InvalidParameter, "positions: .* not finite"),
        ([[0, 1e39, 0]], errors.InvalidParameter, "positions: .* not finite"),
        (np.zeros((2, 3), complex), errors.WrongType, "positions: .* real numbers"),
        ("water", errors.WrongType, "positions: .* real numbers"),
    ],
)
def test_bad_positions_are_refused(renderer, positions, error, match):
    with pytest.raises(error, match=match):
        renderer.render(positions, pbf.Camera())


@pytest.mark.parametrize("style", ["fluid", "spheres"])
@pytest.mark.parametrize("far", [1e6, 1e19, 1e30, 3e38])
def test_a_particle_that_flew_off_leaves_the_picture_as_it_is(renderer, style, far):
    x = pbf.block((-0.3, 0, -0.2), (0.3, 0.4, 0.2), spacing=0.04)
    params = pbf.RenderParams(style=style, radius=0.05, drop_radius=0.025)
    expected = renderer.render(x, pbf.Camera(), params)
    with_far = np.concatenate([x, [[far, far, -far], [-far, far, 0]]])
    np.testing.assert_array_equal(renderer.render(with_far, pbf.Camera(), params), expected)


@pytest.mark.parametrize("style", ["fluid", "spheres"])
def test_a_cloud_as_wide_as_floats_go_can_be_drawn(renderer, style):
    """There is a shadow then, and it may be anywhere."""
    x = np.float32(3e38) * pbf.ball((0, 0, 0), 1, spacing=0.5)
    params = pbf.RenderParams(style=style)
    assert renderer.render(x, pbf.Camera(), params).shape == (120, 160, 4)


@pytest.mark.parametrize(
    ("fields", "match"),
    [
        ({"eye": (1, 1, 1), "target": (1, 1, 1)}, "Camera.target .* must differ from eye"),
        ({"eye": (0, 5, 0), "target": (0, 0, 0)}, "Camera.up .* parallel"),
        ({"up": (0, 0, 0)}, "Camera.up .* zero"),
        ({"fov_y": 0}, "Camera.fov_y = 0 degrees"),
        ({"fov_y": 180}, "Camera.fov_y = 180 degrees"),
        ({"near": 2, "far": 1}, "Camera.near = 2 m: must be less than far = 1"),
        ({"height": -1}, "Camera.height = -1 m"),
    ],
)
def test_impossible_cameras_are_refused(fields, match):
    with pytest.raises(errors.InvalidParameter, match=match):
        pbf.Camera(**fields)


@pytest.mark.parametrize(
    ("fields", "match"),
    [
        ({"radius": 0}, "RenderParams.radius = 0 m"),
        ({"absorption": (-1, 0, 0)}, "RenderParams.absorption"),
        ({"smoothing": "box"}, 'RenderParams.smoothing .* "bilateral", "gaussian"'),
        ({"tank_lower": (0, 0, 0)}, "RenderParams.tank_upper .* together"),
        ({"tank_lower": (0, 0, 0), "tank_upper": (1, 0, 1)}, "RenderParams.tank_upper .* exceed"),
        ({"up": (0, 0, 0)}, "RenderParams.up"),
    ],
)
def test_impossible_parameters_are_refused(fields, match):
    with pytest.raises(errors.InvalidParameter, match=match):
        pbf.RenderParams(**fields)
