"""Shaders and C++ draw the same pictures: every feature of a picture, once by each."""

from __future__ import annotations

import numpy as np
import pytest
from support import golden

import pbfluids as pbf
from pbfluids import _core

pytestmark = pytest.mark.gl

SIZE = (245, 183)  # no multiple of a tile or a vector
LOOK = golden.WATER
VIEW = golden.VIEW
HEIGHT = golden.wave()[:, 1]

PICTURES = {
    "sky": {},
    "no floor": {"look": {"floor": False}},
    "plain": {"look": {"background": "plain", "background_color": (0.2, 0.5, 0.7)}},
    "transparent": {"look": {"background": "transparent", "absorption": (3, 12, 30)}},
    "map": {"look": {"background": "map"}, "light": True},
    "map mirrored": {"look": {"reflection": "map", "floor": False}, "light": True},
    "aces": {"look": {"tone_mapping": "aces", "exposure": 1.4}},
    "cut off": {"look": {"tone_mapping": "none", "exposure": 2}},
    "supersampled": {"look": {"supersampling": 2}},
    "thrice, transparent": {"look": {"supersampling": 3, "background": "transparent"}},
    "ellipsoids": {"look": {"anisotropy": 1}},
    "no shadow": {"look": {"shadow": 0}},
    "tilted": {"look": {"up": (0.3, 1, 0.1), "sun_direction": (0.5, 0.3, 0.2)}},
    "glass": {"look": {"refractive_index": 2, "absorption": (1, 1, 1)}},
    "as splatted": {"look": {"smoothing_iterations": 0, "thickness_iterations": 0}},
    "open": {"look": {"tank_lower": None, "tank_upper": None, "floor_height": -0.02}},
    "spheres": {"look": {"style": "spheres"}},
    "spheres by height": {"look": {"style": "spheres", "legend": "y [m]"}, "values": HEIGHT},
    "by height": {"look": {"legend": "y [m]"}, "values": HEIGHT},
    "colored glass": {"look": {"tint_depth": 0.2, "colormap": "coolwarm"}, "values": HEIGHT},
    "mesh": {"meshes": [golden.ring()]},
    "mesh, transparent": {"look": {"background": "transparent"}, "meshes": [golden.ring()]},
    "mesh and spheres": {"look": {"style": "spheres"}, "meshes": [golden.ring()]},
    "parallel": {"view": {"orthographic": True, "height": 1.2}, "meshes": [golden.ring()]},
    "cut open": {"view": {"near": 1.2}, "meshes": [golden.ring()]},
    "from below": {"view": {"eye": (0.5, -0.5, 2.0)}},
    "wide": {"view": {"fov_y": 110, "eye": (0.9, 0.4, 0.8)}},
}


def pictures(name):
    """Give the pictures of C++ and of shaders, colors multiplied by alpha."""
    of = PICTURES[name]
    look, view = LOOK.replace(**of.get("look", {})), VIEW.replace(**of.get("view", {}))
    light = golden.lamps() if of.get("light") else None
    things = {key: of[key] for key in ("meshes", "values") if key in of}
    for backend in ("cpu", "egl"):
        with pbf.Renderer(*SIZE, backend=backend, environment_map=light) as renderer:
            image = renderer.render(golden.wave(), view, look, **things).astype(float)
        # The color of a pixel that is nearly clear is a quotient of two small whole numbers.
        image[..., :3] *= image[..., 3:] / 255
        yield image


@pytest.mark.parametrize("name", PICTURES)
def test_a_picture_is_the_same_by_shaders_and_by_cpp(name):
    cpp, shaders = pictures(name)
    assert shaders[..., :3].std() > 5
    # One or two of 255: sums in another order, and roots, exponentials and the encoding of sRGB to
    # other last digits, on both sides of a rounding. The rest is pixels where a rounding decides
    # between two answers: of two spheres the nearer, a ray mirrored totally or not, a triangle's
    # edge that passes a pixel's middle.
    difference = np.abs(cpp - shaders).max(axis=2)
    assert (difference > 2).mean() < 1e-3
    assert difference.mean() < 0.8


@pytest.mark.parametrize("style", ["fluid", "spheres"])
def test_cpp_draws_the_same_bits_with_any_instruction_set(style, monkeypatch):
    look = LOOK.replace(style=style, background="map", tone_mapping="aces", supersampling=2)
    with pbf.Renderer(*SIZE, backend="cpu", environment_map=golden.lamps()) as renderer:
        images = []
        for isa in _core.instruction_sets():
            monkeypatch.setenv("PBF_ISA", isa)
            renderer.set_environment_map(golden.lamps())  # forgets the background
            images.append(
                renderer.render(golden.wave(), VIEW, look, meshes=[golden.ring()], values=HEIGHT)
            )
    assert all(np.array_equal(image, images[0]) for image in images)


def test_both_cut_spheres_off_behind_a_mesh():
    wall = pbf.Mesh([[-1, -1, -1], [1, -1, -1], [1, 1, -1], [-1, 1, -1]], [[0, 1, 2], [0, 2, 3]])
    camera = pbf.Camera(eye=(0, 0, 0), target=(0, 0, -1))
    look = pbf.RenderParams(style="spheres", sphere_radius=0.1, floor=False, shadow=0)
    for backend in ("cpu", "egl"):
        with pbf.Renderer(64, 64, backend=backend) as renderer:
            alone = renderer.render(np.zeros((0, 3)), camera, look, meshes=[wall])
            behind = renderer.render([[0, 0, -1.5]], camera, look, meshes=[wall])
            before = renderer.render([[0, 0, -0.5]], camera, look, meshes=[wall])
        assert np.array_equal(behind, alone)
        assert (before[32, 32] != alone[32, 32]).any()
