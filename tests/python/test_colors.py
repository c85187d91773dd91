"""Particles colored by values, as spheres and as fluid, against NumPy."""

from __future__ import annotations

import itertools
import os
import subprocess
import sys

import numpy as np
import pytest
from support.optics import linear

import pbfluids as pbf
from pbfluids import errors
from pbfluids.render import colors

ALONG_Z = {"eye": (0, 0, 0), "target": (0, 0, -1)}
PLAIN = {"background": "plain", "background_color": (0, 0, 0), "floor": False}
ORDERED = ["viridis", "magma", "cividis", "coolwarm", "gray"]
SUN = np.array([-0.45, 0.8, 0.35]) / np.linalg.norm([-0.45, 0.8, 0.35])


@pytest.mark.parametrize("name", ORDERED)
def test_a_map_is_the_one_of_its_name(name):
    matplotlib = pytest.importorskip("matplotlib")
    values = np.random.default_rng(1).uniform(-0.5, 1.5, 5000).astype(np.float32)
    ours = colors(values, pbf.RenderParams(colormap=name, color_range=(0, 1)))
    theirs = matplotlib.colormaps[name](values.astype(float), bytes=True)[:, :3]
    # Their bytes are cut off in one version and rounded in another.
    assert np.abs(ours.astype(int) - theirs).max() <= 1
    assert len(np.unique(ours, axis=0)) > 200


def test_equal_steps_of_value_are_equal_steps_of_index_and_the_ends_hold_what_is_beyond():
    params = pbf.RenderParams(colormap="gray", color_range=(-2, 6))
    values = np.linspace(-5, 9, 1401, dtype=np.float32)
    index = np.clip(np.floor((values.astype(float) + 2) / 8 * 256), 0, 255).astype(int)
    table = colors(np.arange(256) + 0.5, params.replace(color_range=(0, 256)))
    assert np.array_equal(colors(values, params), table[index])
    assert len(np.unique(table, axis=0)) == 256


def test_without_a_range_the_values_span_the_map():
    gray = pbf.RenderParams(colormap="gray")
    assert colors([3, 5, 4], gray)[:, 0].tolist() == [0, 255, 128]
    for same in (0.0, -7.5, 1e9):
        assert not colors([same, same], gray).any()


def test_shuffled_colors_tell_ids_apart():
    params = pbf.RenderParams(colormap="shuffled")
    rows = colors(np.arange(256), params).astype(int)
    assert len(np.unique(rows, axis=0)) > 250
    assert np.abs(np.diff(rows, axis=0)).sum(axis=1).min() > 60
    assert np.array_equal(colors(np.arange(-512, 0), params), np.concatenate([rows, rows]))


def test_a_sphere_has_the_color_of_lambert(renderer):
    center, radius = np.array([0.1, -0.05, -2.0]), 0.4
    camera = pbf.Camera(**ALONG_Z, orthographic=True, height=1.2)  # a pixel is 0.01 m
    params = pbf.RenderParams(
        style="spheres", sphere_radius=radius, colormap="coolwarm", color_range=(0, 1), **PLAIN
    )
    image = renderer.render([center], camera, params, values=[0.1])
    base = linear(colors([0.1], params)[0])
    x, y = np.meshgrid((np.arange(160) - 79.5) * 0.01, -(np.arange(120) - 59.5) * 0.01)
    x, y = x - np.float32(center[0]), y - np.float32(center[1])
    inside = x**2 + y**2 < 0.99 * radius**2
    normal = np.stack([x, y, np.sqrt(np.maximum(radius**2 - x**2 - y**2, 0))], axis=-1) / radius
    sun = 0.60 * np.maximum(normal @ SUN, 0)
    sky = 0.22 + (0.40 - 0.22) * (0.5 + 0.5 * normal[..., 1])
    expected = base * (sun + sky)[..., None]
    assert expected[inside].max() < 0.8  # below the tone curve's shoulder
    shown = linear(image[..., :3])
    assert np.abs(shown - expected)[inside].max() < 0.006  # 8 bits of sRGB
    assert not image[x**2 + y**2 > 1.01 * radius**2][:, :3].any()


def test_of_two_spheres_the_nearer_is_seen_with_its_depth_and_normal(renderer):
    camera = pbf.Camera(**ALONG_Z, fov_y=40)
    params = pbf.RenderParams(style="spheres", sphere_radius=0.3, **PLAIN)
    centers = np.float32([[0, 0, -3], [0.2, 0.05, -3.1]])  # they overlap
    half = np.tan(np.radians(20))
    u = (2 * (np.arange(160) + 0.5) / 160 - 1) * half * 160 / 120
    v = -(2 * (np.arange(120) + 0.5) / 120 - 1) * half
    ray = np.stack([*np.meshgrid(u, v), -np.ones((120, 160))], axis=-1)
    length2 = (ray**2).sum(axis=-1)
    depths, edges, nothing = [], np.zeros((120, 160), bool), 1e9
    for center in centers.astype(float):
        middle = ray @ center / length2
        discriminant = 0.09 - ((center - middle[..., None] * ray) ** 2).sum(axis=-1)
        edges |= np.abs(discriminant) < 1e-3
        front = middle - np.sqrt(np.maximum(discriminant, 0) / length2)
        depths.append(np.where(discriminant > 0, front, nothing))
    nearest = np.min(depths, axis=0)
    which = np.argmin(depths, axis=0)
    for order in ([0, 1], [1, 0]):
        layers = renderer.layers(centers[order], camera, params)
        assert set(layers) == {"depth", "normal"}
        sure = ~edges & (nearest < nothing)
        assert layers["depth"][sure] == pytest.approx(nearest[sure], rel=2e-6)
        assert not layers["depth"][~edges & (nearest == nothing)].any()
        expected = (nearest[..., None] * ray - centers[which]) / 0.3
        sure &= np.abs(depths[0] - depths[1]) > 1e-4
        assert np.abs(layers["normal"] - expected)[sure].max() < 1e-4
        image = renderer.render(
            centers[order],
            camera,
            params.replace(colormap="gray", color_range=(0, 1)),
            values=np.float32([0, 1])[order],
        )
        lit = image[..., 0] > 60
        assert np.array_equal(lit[sure & (which == 1)], np.ones((sure & (which == 1)).sum(), bool))
        assert not lit[sure & (which == 0)].any()


def test_spheres_nearby_darken_and_one_alone_is_not(renderer):
    camera = pbf.Camera(eye=(0, 2, 0), target=(0, 0, 0), up=(0, 0, -1), fov_y=20)
    params = pbf.RenderParams(style="spheres", sphere_radius=0.05, **PLAIN)
    x, z = np.meshgrid(np.arange(-5, 6) * 0.1, np.arange(-5, 6) * 0.1)
    sheet = np.stack([x, 0 * x, z], axis=-1).reshape(-1, 3)
    hole = np.delete(sheet, 60, axis=0)
    below = np.vstack([hole, [[0, -0.1, 0]]])
    alone = renderer.render([[0, -0.1, 0]], camera, params)[60, 80, :3].astype(int)
    in_hole = renderer.render(below, camera, params)[60, 80, :3].astype(int)
    assert (in_hole < 0.9 * alone).all()
    assert (in_hole > 0.3 * alone).all()


def test_fluid_has_the_colors_of_its_surface(renderer):
    # Two sheets, the far one with the other color: weights say how much of it shows.
    x, y = np.meshgrid(np.arange(-40, 41) * 0.02, np.arange(-40, 41) * 0.02)
    near = np.stack([x, y, 0 * x - 2], axis=-1).reshape(-1, 3)
    far = near - [0, 0, 0.1]
    camera = pbf.Camera(**ALONG_Z, fov_y=30)
    params = pbf.RenderParams(
        radius=0.02, refractive_index=1, colormap="gray", color_range=(0, 1), **PLAIN
    )
    one = renderer.render(near, camera, params, values=np.full(len(near), 0.5))
    both = renderer.render(
        np.vstack([near, far]),
        camera,
        params,
        values=np.repeat([0.5, 0.0], len(near)),
    )
    patch = np.s_[40:80, 60:100, 0]
    assert one[patch].std() < 3
    assert np.abs(both[patch].astype(float).mean() / one[patch].mean() - 1) < 0.03
    # Its own color under sky and sun, where opaque: scatter's place in the composite.
    lit = 0.60 + 0.35 * SUN[2]
    thickness = renderer.layers(near, camera, params)["thickness_smooth"][patch[:2]].mean()
    expected = linear(128) * lit * (1 - np.exp(-thickness / 0.02))
    assert linear(one[patch]).mean() == pytest.approx(expected, rel=0.03)


def test_tint_depth_makes_colored_glass(renderer):
    x, y = np.meshgrid(np.arange(-40, 41) * 0.02, np.arange(-40, 41) * 0.02)
    sheet = np.stack([x, y, 0 * x - 2], axis=-1).reshape(-1, 3)
    camera = pbf.Camera(**ALONG_Z, fov_y=30)
    white = {**PLAIN, "background_color": (0.5, 0.5, 0.5)}
    params = pbf.RenderParams(radius=0.02, refractive_index=1, colormap="gray", **white)
    depth = 0.05
    glass = params.replace(tint_depth=depth, color_range=(1, 2))
    image = renderer.render(sheet, camera, glass, values=np.ones(len(sheet)))
    thickness = renderer.layers(sheet, camera, glass)["thickness_smooth"][40:80, 60:100]
    expected = 0.5 * np.exp(-thickness / depth)  # what is behind; the fluid itself is black
    assert linear(image[40:80, 60:100, 0]).mean() == pytest.approx(expected.mean(), rel=0.03)


@pytest.mark.parametrize("style", ["fluid", "spheres"])
def test_colors_have_the_same_bits_for_any_number_of_threads(style, backend):
    code = f"""
import hashlib, numpy as np, pbfluids as pbf
x = np.random.default_rng(1).uniform(-0.5, 0.5, (4000, 3)) - [0, 0, 2]
params = pbf.RenderParams(style="{style}", radius=0.04, legend="x")
with pbf.Renderer(320, 240, backend="{backend}") as renderer:
    image = renderer.render(x, pbf.Camera(eye=(0, 0, 0), target=(0, 0, -1)), params, values=x[:, 0])
print(hashlib.sha256(image).hexdigest())
"""
    hashes = set()
    for threads in "1", "3":
        environment = {"LP_NUM_THREADS": threads, "OMP_NUM_THREADS": threads}
        done = subprocess.run(
            [sys.executable, "-c", code],
            env={**os.environ, "PYTHONPATH": os.pathsep.join(sys.path), **environment},
            capture_output=True,
            text=True,
            check=True,
        )
        hashes.add(done.stdout)
    assert len(hashes) == 1


@pytest.mark.parametrize(
    ("values", "error", "match"),
    [
        ([1, np.nan], errors.InvalidParameter, "values: .* not finite"),
        ([1, np.inf], errors.InvalidParameter, "values: .* not finite"),
        ([1, 2, 3], errors.InvalidParameter, "values: 3 rows, but positions has 2"),
        ([[1, 2]], errors.InvalidParameter, r"values: expected shape \(n,\)"),
        (["fast", "slow"], errors.WrongType, "values: .* real numbers"),
    ],
)
def test_bad_values_are_refused(renderer, values, error, match):
    with pytest.raises(error, match=match):
        renderer.render(np.zeros((2, 3)), pbf.Camera(), values=values)


@pytest.mark.parametrize(
    ("fields", "match"),
    [
        ({"color_range": (1, 1)}, r"color_range = \(1, 1\): the first must be less"),
        ({"color_range": (0, np.nan)}, "color_range"),
        ({"colormap": "jet"}, 'colormap .* "viridis", "magma"'),
        ({"colormap": "shuffled", "legend": "id"}, 'legend = "id": the colors of shuffled'),
        ({"style": "voxels"}, 'style .* "fluid", "spheres"'),
        ({"sphere_radius": 0}, "sphere_radius = 0 m"),
    ],
)
def test_impossible_parameters_are_refused(fields, match):
    with pytest.raises(errors.InvalidParameter, match=match):
        pbf.RenderParams(**fields)


@pytest.mark.parametrize("low", [0.0, -3.7, 998.2, -1e-6, 2.5e7])
@pytest.mark.parametrize("span", [1e-7, 0.013, 1.0, 3.96, 47.0, 8000.0, 3e9])
def test_ticks_are_at_nice_numbers_and_say_what_they_are(low, span):
    low, high = float(np.float32(low)), float(np.float32(low + span))
    if not high - low > 1e-4 * abs(low):
        pytest.skip("float32 holds no such range")
    ticks, exponent = pbf._core.legend_ticks(low, high)
    numbers = [value for value, _ in ticks]
    assert 3 <= len(ticks) <= 7
    step = numbers[1] - numbers[0]
    assert np.allclose(np.diff(numbers), step, rtol=1e-6)
    mantissa = step / 10 ** np.floor(np.log10(step) + 1e-9)
    assert min(abs(mantissa - nice) for nice in (1, 2, 5)) < 1e-6
    assert low - 1e-5 * step <= numbers[0] < low + 1.00001 * step
    assert high - 1.00001 * step < numbers[-1] <= high + 1e-5 * step
    for value, text in ticks:
        shown = float(text.replace("\N{MINUS SIGN}", "-")) * 10.0**exponent
        assert shown == pytest.approx(value, abs=1e-6 * step + 1e-9 * abs(value))
        assert text != "-0"
    texts = [text for _, text in ticks]
    assert len(set(texts)) == len(texts)
    assert max(map(len, texts)) <= 9


@pytest.mark.parametrize("size", [(1280, 720), (3840, 2160)])
def test_the_legend_shows_the_map_in_the_corner_as_large_as_the_picture_asks(size):
    camera, x = pbf.Camera(), [[0.0, 0, 0], [0.1, 0, 0]]
    params = pbf.RenderParams(style="spheres", color_range=(0, 3), **PLAIN)
    with pbf.Renderer(*size) as large:
        without = large.render(x, camera, params, values=[0, 3])
        legend = large.render(x, camera, params.replace(legend="speed [m/s]"), values=[0, 3])
        none = large.render(x, camera, params.replace(legend="speed [m/s]"))
    assert np.array_equal(none[..., 3], without[..., 3])
    rows, columns = np.nonzero((legend != without).any(axis=-1))
    width, height = size
    assert columns.min() > 0.8 * width
    assert columns.max() < width
    assert rows.max() < 0.45 * height
    assert rows.max() - rows.min() > 0.2 * height
    # A column of the bar is the map, from the top down.
    table = colors(np.linspace(3, 0, 512), params)
    for column in range(columns.min(), columns.max()):
        bar = legend[rows.min() : rows.max(), column, :3]
        found = [np.abs(bar.astype(int) - color).sum(axis=1).argmin() for color in table]
        exact = [
            np.abs(bar[k].astype(int) - c).max() == 0 for k, c in zip(found, table, strict=True)
        ]
        if np.mean(exact) > 0.55:
            assert all(a <= b for a, b in itertools.pairwise(np.array(found)[exact]))
            return
    pytest.fail("no column shows the map")


def test_letters_are_sharp_ink_on_paper():
    # The number 3 of the legend is darker than the panel and nothing is drawn outside of it.
    with pbf.Renderer(1280, 720) as large:
        params = pbf.RenderParams(style="spheres", color_range=(0, 3), legend="a", **PLAIN)
        image = large.render([[0.0, 0, 0]], pbf.Camera(), params, values=[1])
        other = large.render(
            [[0.0, 0, 0]],
            pbf.Camera(),
            params.replace(legend="\N{GREEK SMALL LETTER RHO}"),
            values=[1],
        )
    changed = (image != other).any(axis=-1)
    rows, columns = np.nonzero(changed)
    assert 8 <= rows.max() - rows.min() <= 24
    assert 6 <= columns.max() - columns.min() <= 24
    ink = image[rows.min() : rows.max() + 1, columns.min() : columns.max() + 1, :3].max(axis=-1)
    assert ink.min() < 60
    assert ink.max() > 180


@pytest.mark.parametrize("radius", [0.02, 0.15, 0.45])  # from points to what only quads can draw
@pytest.mark.parametrize("x", [0.0, 0.75, -0.8])  # in the middle, and with a center out of sight
def test_no_pixel_of_a_sphere_is_lost_whatever_its_size_and_place(radius, x, backend):
    camera = pbf.Camera(**ALONG_Z, orthographic=True, height=1.2)  # a pixel is 1/400 m
    params = pbf.RenderParams(style="spheres", sphere_radius=radius)
    with pbf.Renderer(600, 480, backend=backend) as large:
        depth = large.layers([[x, 0.1, -2]], camera, params)["depth"]
    u, v = np.meshgrid((np.arange(600) - 299.5) / 400, -(np.arange(480) - 239.5) / 400)
    height2 = radius**2 - (u - x) ** 2 - (v - 0.1) ** 2
    inside, outside = height2 > 1e-5, height2 < -1e-5
    expected = 2 - np.sqrt(np.maximum(height2, 0))
    assert depth[inside] == pytest.approx(expected[inside], abs=2e-5)
    assert not depth[outside].any()
