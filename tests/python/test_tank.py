"""Fluid at the walls of a tank: as flat as the glass, and mirrored by it as Snell says."""

from __future__ import annotations

import numpy as np
import pytest
from support.optics import fresnel

import pbfluids as pbf

pytestmark = pytest.mark.gl

INDEX = 1.333
SPACING = 0.02
PLAIN = pbf.RenderParams(
    radius=1.2 * SPACING,
    drop_radius=0.62 * SPACING,
    particle_volume=SPACING**3,
    reflection="plain",
    background_color=(0, 0, 0),
    floor=False,
    tank_lower=(0, 0, 0),
    tank_upper=(0.8, 0.6, 0.8),
    tone_mapping="none",
)


@pytest.fixture(scope="module", params=["cpu", "egl"])
def renderer(request):
    with pbf.Renderer(240, 240, backend=request.param) as made:
        yield made


def from_above(degrees, turned, target):
    """A parallel view that comes in at an angle below the horizon, turned about the vertical."""
    a, b = np.radians(degrees), np.radians(turned)
    back = np.array([np.sin(b) * np.cos(a), np.sin(a), np.cos(b) * np.cos(a)])
    return pbf.Camera(eye=target + 3 * back, target=target, orthographic=True, height=0.6)


def encoded(light):
    return np.where(light > 0.0031308, 1.055 * light ** (1 / 2.4) - 0.055, 12.92 * light) * 255


@pytest.mark.parametrize("deep", [0.1, 0.3])
def test_a_bottom_over_air_mirrors_what_meets_it_flat(renderer, deep):
    # Between bottom and surface the light goes back and forth, however deep the water is.
    far, absorption = 0.9, 1.2
    camera = from_above(20, 0, np.array([0.4, deep / 2, far]))
    params = PLAIN.replace(
        background="transparent",
        absorption=(absorption,) * 3,
        scatter=(0, 0, 0),
        tank_upper=(0.8, 0.6, far),
    )
    x = pbf.block((0, 0, 0), (0.8, deep, far), spacing=SPACING)
    alpha = renderer.render(x, camera, params)[:, 110:130, 3] / 255
    cosine = np.cos(np.radians(20))
    way = far / np.sqrt(1 - (1 - cosine**2) / INDEX**2)
    clear = (1 - fresnel(cosine)) * np.exp(-absorption * way)
    height = deep / 2 + (119.5 - np.arange(240)) / 240 * 0.6 / cosine  # on the front wall [m]
    rows = (height > 0.02) & (height < deep - 0.03)
    assert np.abs(alpha[rows] - (1 - clear)).max() < 0.03


def test_in_a_corner_light_goes_by_way_of_three_walls(renderer):
    # Bottom and side mirror what comes in beside the corner, so that its way to the far wall is as
    # long as anyone's.
    absorption = 1.2
    camera = from_above(15, 15, np.array([0.05, 0.05, 0.8]))
    params = PLAIN.replace(
        background="transparent", absorption=(absorption,) * 3, scatter=(0, 0, 0)
    )
    x = pbf.block((0, 0, 0), (0.8, 0.6, 0.8), spacing=SPACING)
    alpha = renderer.render(x, camera, params)[..., 3] / 255
    cosine = np.cos(np.radians(15)) ** 2
    way = 0.8 / np.sqrt(1 - (1 - cosine**2) / INDEX**2)
    clear = (1 - fresnel(cosine)) * np.exp(-absorption * way)
    corner = alpha[105:125, 115:135]  # 0.02 to 0.07 m beside it, with an edge of the tank
    assert np.quantile(np.abs(corner - (1 - clear)), 0.75) < 0.01


def test_at_a_near_wall_the_surface_stays_level(renderer):
    camera = from_above(30, 0, np.array([0.4, 0.3, 0.8]))
    check_faces(renderer, camera, [(0, 1, 0), (0, 0, 1)], across=0)


def test_the_edge_between_two_walls_is_sharp(renderer):
    camera = from_above(15, 45, np.array([0.8, 0.15, 0.8]))
    check_faces(renderer, camera, [(0, 0, 1), (1, 0, 0)], across=1)


def check_faces(renderer, camera, normals, across):
    """Two faces of opaque fluid meet in a straight edge: each has one color up to it."""
    scatter = np.array([0.2, 0.4, 0.6])
    params = PLAIN.replace(background="plain", absorption=(900, 900, 900), scatter=scatter)
    x = pbf.block((0, 0, 0), (0.8, 0.3, 0.8), spacing=SPACING)
    image = renderer.render(x, camera, params)[..., :3].astype(float)
    line = image[30:210, 120] if across == 0 else image[110, 30:210]
    view = np.subtract(camera.eye, camera.target) / 3
    sun = np.array(params.sun_direction) / np.linalg.norm(params.sun_direction)
    off = []
    for n in np.array(normals, float):
        lit = 0.60 + 0.25 * n[1] + 0.35 * n @ sun
        off.append(np.abs(line - encoded((1 - fresnel(n @ view)) * lit * scatter)).max(axis=1))
    is_first, is_second = off[0] < 4, off[1] < 4
    assert is_first[0]
    assert is_second[-1]
    assert (~is_first & ~is_second).sum() <= 3
    assert np.argmin(is_first) + is_second.sum() >= 177
