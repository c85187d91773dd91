"""Light that comes through front and back of the fluid, against Snell's law.

Behind the fluid is an environment map whose color is a linear function of the direction, so that a
pixel says where its ray came from.
"""

from __future__ import annotations

import numpy as np
import pytest
from support.optics import fresnel, linear

import pbfluids as pbf

pytestmark = pytest.mark.gl

INDEX = 1.333
CAMERA = pbf.Camera(eye=(0, 0, 2), target=(0, 0, 0), orthographic=True, height=1.2)
CLEAR = pbf.RenderParams(
    radius=0.03,
    particle_volume=0.02**3,
    background="map",
    reflection="plain",
    background_color=(0, 0, 0),
    floor=False,
    absorption=(0, 0, 0),
    scatter=(0, 0, 0),
    tone_mapping="none",
)


def directions(width=512):
    """A map: (x, y, z) of the direction, -1 to 1, as red, green and blue."""
    height = width // 2
    around = 2 * np.pi * ((np.arange(width) + 0.5) / width - 0.5)  # from -z to the right
    above = np.pi * (0.5 - (np.arange(height) + 0.5) / height)
    y, a = np.sin(above)[:, None], np.cos(above)[:, None]
    ways = np.broadcast_arrays(a * np.sin(around), y, -a * np.cos(around))
    return 0.25 + 0.25 * np.stack(ways, axis=-1)


@pytest.fixture(scope="module", params=["cpu", "egl"])
def renderer(request):
    with pbf.Renderer(120, 120, environment_map=directions(), backend=request.param) as made:
        yield made


def seen(renderer, positions, camera=CAMERA, look=CLEAR):
    """Where each pixel's ray came from, and what Fresnel took is given back."""
    return linear(renderer.render(positions, camera, look)[..., :3]) * 4


def through(light, mirrored=0.0):
    return light / (1 - mirrored) - 1


def turned(points, degrees):
    """About the axis y."""
    c, s = np.cos(np.radians(degrees)), np.sin(np.radians(degrees))
    return points @ np.array([[c, 0, -s], [0, 1, 0], [s, 0, c]])


def middle(light):
    return np.median(light[50:70, 50:70].reshape(-1, 3), axis=0)


BLOCK = pbf.block((-0.6, -0.5, -0.12), (0.6, 0.5, 0.12), spacing=0.02)


@pytest.mark.parametrize("degrees", [0, 20, 40])
def test_what_is_far_behind_a_slab_is_not_displaced(renderer, degrees):
    light = middle(seen(renderer, turned(BLOCK, degrees)))
    mirrored = fresnel(np.cos(np.radians(degrees)))
    assert through(light, mirrored) == pytest.approx([0, 0, -1], abs=0.05)


@pytest.mark.parametrize("degrees", [10, 20])
def test_a_prism_bends_twice(renderer, degrees):
    # The near side faces the camera, the far side is turned.
    slope = np.tan(np.radians(degrees))
    prism = BLOCK[BLOCK[:, 2] > slope * BLOCK[:, 0]]
    out = np.arcsin(INDEX * np.sin(np.radians(degrees))) - np.radians(degrees)
    light = middle(seen(renderer, prism))
    # The far side's normal is (slope, 0, -1) over its length: rays bend towards the thick end.
    assert through(light, fresnel(1.0)) == pytest.approx([-np.sin(out), 0, -np.cos(out)], abs=0.05)


def test_a_ball_shows_what_is_behind_it_upside_down(renderer):
    x = pbf.block((-0.4, -0.4, -0.4), (0.4, 0.4, 0.4), spacing=0.02)
    light = seen(renderer, x[np.linalg.norm(x, axis=1) < 0.4])
    across = np.linspace(-0.18, 0.18, 19)  # of the ball's center [m]
    pixel = np.round((across / 1.2 + 0.5) * 120 - 0.5).astype(int)
    sine = across / 0.43
    bent = 2 * (np.arcsin(sine) - np.arcsin(sine / INDEX))  # towards the axis
    expected = -np.sin(bent)
    mirrored = fresnel(np.sqrt(1 - sine**2))[:, None]
    row = through(light[58:62, pixel].mean(axis=0), mirrored)
    column = through(light[119 - pixel, 58:62].mean(axis=1), mirrored)
    assert np.abs(row[:, 0] - expected).max() < 0.12
    assert np.abs(column[:, 1] - expected).max() < 0.12


def test_a_drop_behind_a_body_is_no_far_side_of_it(renderer):
    water = CLEAR.replace(radius=0.024, drop_radius=0.0124)
    drops = [(x, y, -0.4) for x in (-0.05, 0.0, 0.05) for y in (-0.03, 0.03)]
    alone = renderer.render(BLOCK, CAMERA, water)
    before_drops = renderer.render(np.concatenate([BLOCK, drops]), CAMERA, water)
    assert np.array_equal(before_drops, alone)


def test_up_to_the_far_edge_of_a_pool_light_comes_through_the_wall(renderer):
    # 15 degrees above the pool: down through the level surface, then out through the far wall.
    pool = pbf.block((-0.6, -0.3, -0.4), (0.6, 0.0, 0.4), spacing=0.02)
    down = np.radians(15)
    eye = (0, 2 * np.sin(down), 2 * np.cos(down))
    camera = pbf.Camera(eye=eye, target=(0, 0, 0), orthographic=True, height=0.4)
    look = CLEAR.replace(
        radius=0.024, drop_radius=0.0124, tank_lower=(-0.6, -0.3, -0.4), tank_upper=(0.6, 0.5, 0.4)
    )
    # From the far edge to where rays come to the bottom first.
    rows = slice(*(int(60 - 120 * z * np.sin(down) / 0.4) for z in (0.4, 0.12)))
    light = seen(renderer, pool, camera, look)[rows, 55:65].mean(axis=1)
    into = np.sqrt(1 - (np.cos(down) / INDEX) ** 2)
    expected = [0, -INDEX * into, -np.sqrt(1 - (INDEX * into) ** 2)]
    assert np.abs(through(light, fresnel(np.sin(down))) - expected).max() < 0.04
