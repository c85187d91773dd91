"""A scene has no size of its own: with all lengths a power of two larger it is the same picture.

Powers of two, since float32 rounds alike at all of them: what differs by a bit is a length that
does not grow along.
"""

from __future__ import annotations

import numpy as np
import pytest
from support import golden

import pbfluids as pbf

pytestmark = pytest.mark.gl

# From sprites of half a micrometer to some of 500 km, both next to the ends of their range.
FACTORS = [2.0**power for power in (-16, -12, 12, 24)]
HEIGHT = golden.wave()[:, 1]
LOOKS = {
    "water": {},
    "open": {"tank_lower": None, "tank_upper": None, "floor_height": -0.02},
    "ellipsoids": {"anisotropy": 1},
    "drops": {"drop_radius": None},
    "narrow_range": {"smoothing": "narrow_range", "thickness_smoothing": "bilateral"},
    "curvature_flow": {"smoothing": "curvature_flow"},
    "tilted": {"up": (0.3, 1, 0.1), "sun_direction": (0.5, 0.3, 0.2)},
    "spheres": {"style": "spheres"},
    "fine": {"supersampling": 4},
}


def looks(params, factor):
    """Give the parameters of a larger scene."""
    lengths = ("radius", "drop_radius", "sphere_radius", "floor_height", "tank_lower", "tank_upper")
    larger = {
        name: tuple(np.multiply(value, factor)) if isinstance(value, tuple) else value * factor
        for name in lengths
        if (value := getattr(params, name)) is not None
    }
    return params.replace(
        **larger,
        particle_volume=params.particle_volume * factor**3,
        absorption=tuple(np.divide(params.absorption, factor)),
    )


def seen_from(camera, factor):
    """Give a larger scene's camera."""
    lengths = ("eye", "target", "near", "far", "height")
    larger = {name: np.multiply(getattr(camera, name), factor) for name in lengths}
    return camera.replace(**{name: value.tolist() for name, value in larger.items()})


def larger_mesh(mesh, factor):
    """Give a mesh of a larger scene."""
    return pbf.Mesh(mesh.vertices * np.float32(factor), mesh.faces, mesh.color)


def picture(renderer, factor, params=golden.WATER, camera=golden.VIEW, meshes=(), **values):
    """Draw the golden pictures' wave, larger."""
    return renderer.render(
        golden.wave() * np.float32(factor),
        seen_from(camera, factor),
        looks(params, factor),
        meshes=[larger_mesh(mesh, factor) for mesh in meshes],
        **values,
    )


@pytest.mark.parametrize("look", LOOKS)
def test_a_picture_does_not_depend_on_the_scene_s_size(renderer, look):
    params = golden.WATER.replace(**LOOKS[look])
    expected = picture(renderer, 1, params)
    assert expected[..., :3].std() > 20
    for factor in FACTORS:
        assert np.array_equal(picture(renderer, factor, params), expected), factor


@pytest.mark.parametrize("orthographic", [False, True])
def test_nor_do_meshes_colors_and_light_from_a_map(renderer, orthographic):
    camera = golden.VIEW.replace(orthographic=orthographic, height=1.2)
    params = golden.WATER.replace(background="map", floor=not orthographic)
    renderer.set_environment_map(golden.lamps())
    for things in ({"meshes": [golden.ring()]}, {"values": HEIGHT}):
        expected = picture(renderer, 1, params, camera, **things)
        for factor in FACTORS:
            found = picture(renderer, factor, params, camera, **things)
            assert np.array_equal(found, expected), factor
    renderer.set_environment_map(None)


@pytest.mark.parametrize("look", LOOKS)
def test_layers_are_lengths_of_the_scene(renderer, look):
    params = golden.WATER.replace(**LOOKS[look])
    expected = renderer.layers(golden.wave(), golden.VIEW, params)
    for factor in FACTORS:
        found = renderer.layers(
            golden.wave() * np.float32(factor),
            seen_from(golden.VIEW, factor),
            looks(params, factor),
        )
        for name, layer in found.items():
            unit = 1 if name == "normal" else factor
            assert np.array_equal(layer / np.float32(unit), expected[name]), (name, factor)


def test_drops_have_normals_where_a_pixel_is_less_than_a_nanometer(renderer):
    # A drop of radius 1 beside a body's edge: what is left of its fifth power must be a number.
    def normals(factor):
        camera = pbf.Camera(
            eye=(0, 0, 4 * factor),
            target=(0, 0, 0),
            orthographic=True,
            height=0.5 * factor,
            near=factor,
            far=8 * factor,
        )
        params = pbf.RenderParams(radius=2 * factor, drop_radius=factor, particle_volume=factor**3)
        # The edge of the sphere crosses the picture.
        return renderer.layers([[0.9 * factor, 0, 0]], camera, params)["normal"]

    expected = normals(1.0)
    assert (expected[..., 2] > 0).any()
    assert np.array_equal(normals(2.0**-23), expected)
