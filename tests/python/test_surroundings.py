"""Meshes and environment maps around the fluid, against closed forms, and what they refuse."""

from __future__ import annotations

import numpy as np
import pytest
from support.optics import linear

import pbfluids as pbf
from pbfluids import errors

pytestmark = pytest.mark.gl

ALONG_Z = {"eye": (0, 0, 0), "target": (0, 0, -1)}
NOTHING = np.zeros((0, 3))
# A wall of fluid, 0.3 m deep, whose front is at z = -1.7.
WALL = pbf.block((-1.6, -1.2, -2.0), (1.6, 1.2, -1.7), spacing=0.04)
SUN = np.array([0, 1, 1]) / np.sqrt(2)


def light_in(image):
    return linear(image[..., :3])


def params(**changes):
    """Clear-cut: a white plain background, nothing mirrored, nothing scattered."""
    fields = {
        "radius": 0.048,
        "particle_volume": 0.04**3,
        "background": "plain",
        "floor": False,
        "refractive_index": 1.0,
        "scatter": (0, 0, 0),
        "absorption": (4, 2, 0),
        "sun_direction": SUN,
        "tone_mapping": "none",
    }
    return pbf.RenderParams(**{**fields, **changes})


def rectangle(lower, upper, z, color=(0.5, 0.4, 0.3), slope=0.0):
    """A rectangle that faces the camera; z grows by slope with x."""
    (x0, y0), (x1, y1) = lower, upper
    corners = [(x0, y0), (x1, y0), (x1, y1), (x0, y1)]
    vertices = [(x, y, z + slope * x) for x, y in corners]
    return pbf.Mesh(vertices, [(0, 1, 2), (0, 2, 3)], color)


def light_on(normal, color, up=(0, 1, 0)):
    """What a triangle sends back."""
    sun = 0.45 * max(np.dot(normal, SUN), 0) / max(np.dot(up, SUN), 0.3)
    return (0.35 + 0.2 * np.dot(normal, up) + sun) * np.asarray(color)


def rays(camera, width=160, height=120):
    """Slopes x/depth, y/depth of the pixels' rays; row 0 on top."""
    half = np.tan(np.radians(camera.fov_y) / 2)
    x = (2 * (np.arange(width) + 0.5) / width - 1) * half * width / height
    y = -(2 * (np.arange(height) + 0.5) / height - 1) * half
    return np.meshgrid(x, y)


def test_a_mesh_alone_is_where_and_as_bright_as_it_should_be(renderer):
    camera = pbf.Camera(**ALONG_Z)
    mesh = rectangle((-0.4, -0.3), (0.5, 0.2), -2)
    image = light_in(renderer.render(NOTHING, camera, params(), meshes=[mesh]))
    x, y = (2 * slope for slope in rays(camera))
    inside = (x > -0.4) & (x < 0.5) & (y > -0.3) & (y < 0.2)
    expected = np.where(inside[..., None], light_on((0, 0, 1), (0.5, 0.4, 0.3)), 1.0)
    assert np.abs(image - expected).max() < 0.006


def test_before_the_fluid_a_mesh_hides_it(renderer):
    camera = pbf.Camera(**ALONG_Z)
    mesh = rectangle((-0.4, -0.3), (0.5, 0.2), -1)
    alone = renderer.render(NOTHING, camera, params(), meshes=[mesh])
    both = renderer.render(WALL, camera, params(), meshes=[mesh])
    x, y = rays(camera)
    inside = (x > -0.4) & (x < 0.5) & (y > -0.3) & (y < 0.2)
    assert np.array_equal(both[inside], alone[inside])
    assert (both[~inside] != alone[~inside]).any(axis=-1).mean() > 0.9


def test_a_mesh_through_the_fluid_is_seen_up_to_where_it_enters(renderer):
    # Black fluid, and a plane that enters it at x = 0.
    camera, black = pbf.Camera(**ALONG_Z), params(absorption=(1e4, 1e4, 1e4))
    mesh = rectangle((-1.5, -1.2), (1.5, 1.2), -1.7, slope=-0.5)
    image = light_in(renderer.render(WALL, camera, black, meshes=[mesh]))
    front = renderer.layers(WALL, camera, black)["depth_smooth"]
    x, _ = rays(camera)
    depth = 1.7 / (1 - 0.5 * x)  # of the plane
    normal = np.array([0.5, 0, 1]) / np.hypot(0.5, 1)
    before, behind = depth < front - 0.01, depth > front + 0.01
    assert before.sum() > 3000
    assert behind.sum() > 3000
    assert np.abs(image[before] - light_on(normal, (0.5, 0.4, 0.3))).max() < 0.006
    assert image[behind].max() < 0.01


@pytest.mark.parametrize("gap", [0.1, 0.2])
def test_in_the_fluid_a_mesh_is_seen_through_the_fluid_before_it(renderer, gap):
    camera = pbf.Camera(**ALONG_Z, orthographic=True, height=1.6)
    mesh = rectangle((-1.5, -1.2), (1.5, 1.2), -1.7 - gap)
    image = light_in(renderer.render(WALL, camera, params(), meshes=[mesh]))[40:80, 60:100]
    front = renderer.layers(WALL, camera, params())["depth_smooth"][40:80, 60:100]
    way = 1.7 + gap - front[..., None]  # spheres stick out by a little
    expected = light_on((0, 0, 1), (0.5, 0.4, 0.3)) * np.exp(-np.array([4, 2, 0]) * way)
    assert np.abs(image - expected).max() < 0.01


def test_behind_the_fluid_a_mesh_is_seen_through_all_of_it(renderer):
    camera = pbf.Camera(**ALONG_Z, orthographic=True, height=1.6)
    mesh = rectangle((-2, -2), (2, 2), -3)
    image = light_in(renderer.render(WALL, camera, params(), meshes=[mesh]))[40:80, 60:100]
    thickness = renderer.layers(WALL, camera, params())["thickness_smooth"][40:80, 60:100, None]
    expected = light_on((0, 0, 1), (0.5, 0.4, 0.3)) * np.exp(-np.array([4, 2, 0]) * thickness)
    assert np.abs(image - expected).max() < 0.01


def test_a_bent_ray_finds_the_mesh_where_snell_says(renderer):
    # Over a pool with a striped floor, looked at under 45 degrees: stripes stand where bent rays
    # meet them, not where straight ones would.
    pool = pbf.block((-1, -0.3, -1), (1, 0, 1), spacing=0.04)
    camera = pbf.Camera(eye=(0, 1, 1), target=(0, 0, 0), fov_y=25)
    sides = [(-1.5, 0.0, (0.9, 0.9, 0.9)), (0.0, 1.5, (0.05, 0.05, 0.05))]  # far, near in -z
    meshes = [
        pbf.Mesh(
            [(-2, -0.3, z0), (-2, -0.3, z1), (2, -0.3, z1), (2, -0.3, z0)],
            [(0, 1, 2), (0, 2, 3)],
            color,
        )
        for z0, z1, color in sides
    ]
    water = params(refractive_index=1.333, absorption=(0, 0, 0), background_color=(0, 0, 0))
    column = light_in(renderer.render(pool, camera, water, meshes=meshes))[:, 80, 1]
    edge = np.flatnonzero(column > 0.3).max() + 0.5  # rows from the top: the far side is bright
    # A ray that leaves the surface at z sees the bottom at z - 0.3 tan(refracted).
    slopes = np.tan(np.radians(12.5)) * (1 - 2 * (np.arange(120) + 0.5) / 120)
    angle = np.radians(45) + np.arctan(slopes)  # from the vertical
    top = 0.02  # of the pool's spheres, smoothed
    bent = np.arcsin(np.sin(angle) / 1.333)
    bottom = 1 - (1 - top) * np.tan(angle) - (0.3 + top) * np.tan(bent)
    expected = np.interp(0, bottom, np.arange(120))
    straight = np.interp(0, 1 - 1.3 * np.tan(angle), np.arange(120))
    assert abs(edge - expected) < 2
    assert abs(straight - expected) > 6


def test_what_a_mesh_hides_of_another_goes_on_behind_it(renderer):
    # A plate stands in a pool with a gray bottom, before nothing: beside it rays bend down behind
    # what hides the bottom from the camera.
    pool = pbf.block((-1, -0.3, -1), (1, 0, 1), spacing=0.04)
    camera = pbf.Camera(eye=(0, 1, 1), target=(0, 0, 0), fov_y=25)
    bottom = pbf.Mesh(
        [(-2, -0.3, -1.5), (-2, -0.3, 1.5), (2, -0.3, 1.5), (2, -0.3, -1.5)],
        [(0, 1, 2), (0, 2, 3)],
        (0.5, 0.5, 0.5),
    )
    plate = rectangle((-0.1, -0.25), (0.1, -0.05), 0, color=(0.9, 0.1, 0.1))
    water = params(refractive_index=1.333, absorption=(0, 0, 0), background_color=(0, 0, 0))
    light = light_in(renderer.render(pool, camera, water, meshes=[bottom, plate]))[20:100, 40:120]
    assert light[..., 0].min() > 0.9 * 0.5 * light_on((0, 1, 0), (1, 1, 1))[0]


def test_from_inside_and_below_the_floor_meshes_are_not_seen(renderer):
    camera = pbf.Camera(**ALONG_Z)
    seen = rectangle((-0.4, -0.3), (0.5, 0.2), -2)
    turned = pbf.Mesh(seen.vertices, seen.faces[:, ::-1], seen.color)
    empty = renderer.render(NOTHING, camera, params())
    assert np.array_equal(renderer.render(NOTHING, camera, params(), meshes=[turned]), empty)
    low = pbf.Camera(eye=(0, 1, 2), target=(0, 0, 0))
    on_floor = params(floor=True, floor_height=0, shadow=0)
    buried = rectangle((-0.4, -0.5), (0.4, -0.1), 0)
    assert np.array_equal(
        renderer.render(NOTHING, low, on_floor, meshes=[buried]),
        renderer.render(NOTHING, low, on_floor),
    )


def test_of_two_meshes_the_nearer_is_seen_in_any_order(renderer):
    camera = pbf.Camera(**ALONG_Z)
    meshes = [rectangle((-0.4, -0.3), (0.5, 0.2), -1), rectangle((-2, -2), (2, 2), -2, (0, 0, 0))]
    one = renderer.render(NOTHING, camera, params(), meshes=meshes)
    assert np.array_equal(one, renderer.render(NOTHING, camera, params(), meshes=meshes[::-1]))
    assert light_in(one)[60, 80] == pytest.approx(light_on((0, 0, 1), (0.5, 0.4, 0.3)), abs=0.006)


def test_a_mesh_casts_a_shadow_away_from_the_sun(renderer):
    roof = pbf.Mesh(
        [(-0.5, 1, -0.5), (-0.5, 1, 0.5), (0.5, 1, 0.5), (0.5, 1, -0.5)], [(0, 1, 2), (0, 2, 3)]
    )
    camera = pbf.Camera(eye=(0, 0.8, 0), target=(0, 0, 0), up=(0, 0, -1), fov_y=20)
    base = params(floor=True, floor_height=0, shadow=0.7, sun_direction=(0, 1, 0), radius=0.02)
    lit = light_in(renderer.render(NOTHING, camera, base.replace(shadow=0), meshes=[roof]))
    dark = light_in(renderer.render(NOTHING, camera, base, meshes=[roof]))
    assert (dark / lit)[60, 80] == pytest.approx(0.3, abs=0.01)
    aside = base.replace(sun_direction=(1, 1, 0))  # then it lies at x from -1.5 to -0.5
    without = renderer.render(NOTHING, camera, aside)
    assert np.array_equal(
        renderer.render(NOTHING, camera, aside, meshes=[roof])[60, 80], without[60, 80]
    )


def test_meshes_are_antialiased_and_transparent_pictures_keep_them(renderer):
    camera = pbf.Camera(**ALONG_Z)
    mesh = rectangle((-0.4, -0.3), (0.5, 0.2), -2)
    clear = params(background="transparent", supersampling=4)
    image = renderer.render(NOTHING, camera, clear, meshes=[mesh])
    x, y = (2 * slope for slope in rays(camera))
    area = 0.9 * 0.5
    pixel = (x[0, 1] - x[0, 0]) * (y[0, 0] - y[1, 0])
    assert image[..., 3].sum() / 255 * pixel == pytest.approx(area, rel=0.01)
    assert 0 < np.sort(np.unique(image[..., 3]))[1] < 255


@pytest.mark.parametrize(
    ("vertices", "faces", "color", "error", "match"),
    [
        ([[0, 0]], [[0, 0, 0]], (0, 0, 0), errors.InvalidParameter, r"vertices: .* \(n, 3\)"),
        ([[0, np.inf, 0]], [[0, 0, 0]], (0, 0, 0), errors.InvalidParameter, "vertices: .*finite"),
        ([[0, 0, 0]], [[0, 0, 1]], (0, 0, 0), errors.InvalidParameter, "row 0 names vertex 1, "),
        ([[0, 0, 0]], [[0, -1, 0]], (0, 0, 0), errors.InvalidParameter, "names vertex -1, "),
        ([[0, 0, 0]], [[0, 0]], (0, 0, 0), errors.InvalidParameter, r"faces: .* \(m, 3\)"),
        ([[0, 0, 0]], [[0.5, 0, 0]], (0, 0, 0), errors.WrongType, "faces: .* whole numbers"),
        ([[0, 0, 0]], "water", (0, 0, 0), errors.WrongType, "faces: .* whole numbers"),
        ([[0, 0, 0]], [[0, 0, 0]], (0, 2, 0), errors.InvalidParameter, r"Mesh.color = \(0, 2, 0\)"),
    ],
)
def test_impossible_meshes_are_refused(vertices, faces, color, error, match):
    with pytest.raises(error, match=match):
        pbf.Mesh(vertices, faces, color)


def test_a_mesh_gives_back_what_it_was_made_of():
    mesh = pbf.Mesh([[0, 0, 0], [1, 0, 0], [0, 1, 0]], np.array([[0, 1, 2]], np.uint8))
    assert mesh.vertices.shape == (3, 3)
    assert mesh.faces.tolist() == [[0, 1, 2]]
    assert mesh.color == (0.6, 0.6, 0.6)
    assert pbf.Mesh(np.zeros((0, 3)), np.zeros((0, 3), int)).faces.shape == (0, 3)


# One color for each direction: ahead, right, behind, left, up, down.
COLORS = np.array(
    [(0.1, 0.2, 0.3), (0.9, 0.1, 0.1), (0.2, 0.8, 0.2), (0.1, 0.1, 0.7), (0.6, 0.6, 0), (0, 0, 0)]
)


def six_colors():
    """A map of six patches around the directions of the axes."""
    ahead, right, behind, left, up, down = COLORS
    around = np.repeat(np.array([behind, left, ahead, right]), 64, axis=0)
    around = np.roll(around, -32, axis=0)
    rows = [np.tile(up, (32, 256, 1)), np.tile(around, (64, 1, 1)), np.tile(down, (32, 256, 1))]
    return np.concatenate(rows)


def test_a_map_is_seen_where_it_should_be(renderer):
    renderer.set_environment_map(six_colors())
    looks = [(0, 0, -1), (1, 0, 0), (0, 0, 1), (-1, 0, 0), (0, 1, 0), (0, -1, 0)]
    for look, color in zip(looks, COLORS, strict=True):
        up = (0, 0, -1) if look[1] else (0, 1, 0)
        camera = pbf.Camera(eye=(0, 0, 0), target=look, up=up, fov_y=40)
        image = light_in(renderer.render(NOTHING, camera, params(background="map")))
        assert image[60, 80] == pytest.approx(color, abs=0.006)
    renderer.set_environment_map(None)


def test_a_map_is_mirrored_as_fresnel_says_however_bright(renderer):
    # Behind the camera the map is 20 times brighter than white.
    renderer.set_environment_map(six_colors() * 20)
    camera = pbf.Camera(**ALONG_Z, orthographic=True, height=1.6)
    black = params(refractive_index=1.333, absorption=(1e4, 1e4, 1e4), reflection="map")
    image = light_in(renderer.render(WALL, camera, black))[50:70, 70:90].mean(axis=(0, 1))
    head_on = ((1.333 - 1) / (1.333 + 1)) ** 2
    assert image == pytest.approx(20 * head_on * COLORS[2], abs=0.01)
    renderer.set_environment_map(None)


@pytest.mark.parametrize(
    ("light", "error", "match"),
    [
        (np.zeros((4, 8)), errors.InvalidParameter, r"environment_map: .* \(height, width, 3\)"),
        (np.zeros((0, 8, 3)), errors.InvalidParameter, "environment_map: .* at least one pixel"),
        (np.full((4, 8, 3), -1.0), errors.InvalidParameter, "environment_map: .* not negative"),
        (np.full((4, 8, 3), np.nan), errors.InvalidParameter, "environment_map: .* not finite"),
        ("sky.hdr", errors.WrongType, "environment_map: .* real numbers"),
    ],
)
def test_impossible_maps_are_refused(renderer, light, error, match):
    with pytest.raises(error, match=match):
        renderer.set_environment_map(light)


@pytest.mark.parametrize("field", ["background", "reflection"])
def test_without_a_map_there_is_none_to_show(renderer, backend, field):
    camera = pbf.Camera(**ALONG_Z)
    with pytest.raises(errors.InvalidParameter, match="the renderer has no environment map"):
        renderer.render(NOTHING, camera, pbf.RenderParams(**{field: "map"}))
    with pbf.Renderer(16, 16, environment_map=np.ones((2, 4, 3)), backend=backend) as mine:
        assert mine.render(NOTHING, camera, params(**{field: "map"})).min() == 255


STILL = {
    "camera": pbf.Camera(eye=(2, 1.5, 2), target=(0.5, 0.2, 0.25)),
    "params": pbf.RenderParams(radius=0.03, tank_lower=(0, 0, 0), tank_upper=(1, 0.5, 0.5)),
    "positions": pbf.block((0, 0, 0), (0.3, 0.3, 0.5), spacing=0.025),
    "meshes": (),
}
TABLE = rectangle((0.6, 0.0), (0.9, 0.3), 0.2)


@pytest.mark.parametrize(
    "change",
    [
        {"camera": pbf.Camera(eye=(2, 1.5, 2.2), target=(0.5, 0.2, 0.25))},
        {"camera": pbf.Camera(eye=(2, 1.5, 2), target=(0.5, 0.2, 0.25), fov_y=50)},
        {"params": STILL["params"].replace(tank_upper=(1.2, 0.5, 0.5))},
        {"params": STILL["params"].replace(radius=0.035)},
        {"params": STILL["params"].replace(sun_direction=(0.5, 0.8, 0.3))},
        {"params": STILL["params"].replace(shadow=0.0)},
        {"params": STILL["params"].replace(floor_height=-0.1)},
        {"params": STILL["params"].replace(background="plain", background_color=(0.2, 0.5, 0.3))},
        {"params": STILL["params"].replace(exposure=0.7)},
        {"params": STILL["params"].replace(tone_mapping="aces")},
        {"params": STILL["params"].replace(supersampling=2)},
        {"params": STILL["params"].replace(background="transparent")},
        {"positions": STILL["positions"] + np.float32([0.5, 0, 0])},
        {"positions": NOTHING},
        {"meshes": (TABLE,)},
    ],
    ids=str,
)
def test_the_background_that_is_kept_follows_every_change(renderer, backend, change):
    before, after = STILL, {**STILL, **change}
    with pbf.Renderer(160, 120, backend=backend) as fresh:
        expected = fresh.render(**after)
    first = renderer.render(**before)
    assert np.array_equal(renderer.render(**before), first)
    assert np.array_equal(renderer.render(**after), expected)
    assert (expected != first).any()
    assert np.array_equal(renderer.render(**before), first)


def test_the_background_that_is_kept_follows_the_environment_map(renderer):
    camera, mapped = pbf.Camera(**ALONG_Z), params(background="map")
    for color in (0.2, 0.6, 0.4):
        renderer.set_environment_map(np.full((4, 8, 3), color))
        image = light_in(renderer.render(NOTHING, camera, mapped))
        assert image[10, 10] == pytest.approx([color] * 3, abs=0.01)
    renderer.set_environment_map(None)
