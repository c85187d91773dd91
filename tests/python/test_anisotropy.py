"""Sprites as ellipsoids against plain NumPy, through the layers of every backend."""

from __future__ import annotations

import numpy as np
import pytest
from reference import anisotropy as ref

import pbfluids as pbf
from pbfluids import errors

pytestmark = pytest.mark.gl

SIZE = (160, 120)
RADIUS = 0.05


@pytest.fixture(scope="module", params=["cpu", "egl"])
def any_renderer(request):
    with pbf.Renderer(*SIZE, backend=request.param) as made:
        yield made


def cloud():
    """A sheet, a ball and spray."""
    random = np.random.default_rng(3)
    x, z = np.meshgrid(np.arange(-10, 11) * 0.04, np.arange(-8, 9) * 0.04)
    sheet = np.stack([x, -0.2 + 0.2 * x, z - 2], axis=-1).reshape(-1, 3)
    ball = pbf.ball((0.1, 0.2, -2), 0.16, spacing=0.04)
    spray = random.uniform((-0.8, -0.5, -2.3), (0.8, 0.6, -1.7), (40, 3))
    x = np.concatenate([sheet, ball, spray])
    return (x + random.uniform(-0.005, 0.005, x.shape)).astype(np.float32)


@pytest.mark.parametrize("anisotropy", [1.0, 0.4])
@pytest.mark.parametrize("lens", [{"fov_y": 40}, {"orthographic": True, "height": 1.6}])
def test_depth_and_thickness_are_those_of_the_reference(any_renderer, lens, anisotropy):
    camera = pbf.Camera(eye=(0, 0, 0), target=(0, 0, -1), **lens)
    params = pbf.RenderParams(
        radius=RADIUS, anisotropy=anisotropy, smoothing_iterations=0, thickness_iterations=0
    )
    layers = any_renderer.layers(cloud(), camera, params)

    width, height = SIZE
    half = 0.8 if camera.orthographic else np.tan(np.radians(20))
    x, y = np.meshgrid(
        (2 * (np.arange(width) + 0.5) / width - 1) * half * width / height,
        -(2 * (np.arange(height) + 0.5) / height - 1) * half,
    )
    across = np.stack([x.ravel(), y.ravel(), 0 * x.ravel()], axis=1)
    axis = np.zeros_like(across) - (0, 0, 1)
    origins, directions = (across, axis) if camera.orthographic else (0 * across, across + axis)
    ellipsoids = ref.ellipsoids(cloud().astype(float), 2.4 * RADIUS, anisotropy)
    depth, length, margin = ref.first_hits(origins, directions, *ellipsoids, RADIUS)

    clear = (margin > 0.002).reshape(height, width)  # no ray that nearly touches an ellipsoid
    assert clear.mean() > 0.3
    depth, length = depth.reshape(height, width), length.reshape(height, width)
    assert (depth[clear] > 0).mean() > 0.1
    assert layers["depth"][clear] == pytest.approx(depth[clear], rel=1e-4)
    assert layers["thickness"][clear] == pytest.approx(length[clear], rel=1e-3, abs=1e-5)


def test_a_drop_is_the_same_picture_with_and_without(any_renderer):
    camera = pbf.Camera(eye=(0, 0, 0), target=(0, 0, -1))
    drops = [[-0.3, 0, -2], [0.4, 0.2, -2.5]]
    without = any_renderer.layers(drops, camera, pbf.RenderParams(radius=RADIUS))
    stretched = pbf.RenderParams(radius=RADIUS, anisotropy=1)
    for name, layer in any_renderer.layers(drops, camera, stretched).items():
        assert np.allclose(layer, without[name], rtol=1e-6, atol=1e-6), name


def test_ellipsoids_hold_the_volume_of_the_fluid(any_renderer):
    camera = pbf.Camera(eye=(0, 0, 0), target=(0, 0, -1), orthographic=True, height=1.6)
    params = pbf.RenderParams(radius=RADIUS, anisotropy=1, particle_volume=0.04**3)
    layers = any_renderer.layers(cloud(), camera, params)
    volume = layers["thickness"].sum(dtype=float) * (1.6 / SIZE[1]) ** 2
    assert volume == pytest.approx(len(cloud()) * 0.04**3, rel=0.01)


@pytest.mark.parametrize("anisotropy", [-0.1, 1.5, float("nan")])
def test_anisotropy_must_lie_between_0_and_1(any_renderer, anisotropy):
    with pytest.raises(errors.InvalidParameter, match="anisotropy"):
        any_renderer.layers(cloud(), pbf.Camera(), pbf.RenderParams(anisotropy=anisotropy))
