"""The depth filters of the renderer against plain NumPy, and that against formulas."""

from __future__ import annotations

import numpy as np
import pytest
from reference import smoothing as ref

import pbfluids as pbf

SIZE = (128, 96)
RADIUS = 0.03
RANGE = 0.1
SEPARABLE = ["bilateral", "gaussian", "narrow_range"]


def view_of(camera):
    half = 0.5 * camera.height if camera.orthographic else np.tan(np.radians(camera.fov_y) / 2)
    return ref.View(*SIZE, half, not camera.orthographic)


def tilted_plane(view):
    x, y = view.rays() if view.perspective else np.zeros((2, *SIZE[::-1]))
    d = 2 / (1 - 0.3 * x + 0.2 * y)
    d[30:45, 50:60] = 0
    return d


@pytest.mark.parametrize("fov", [20, 60, 90])
@pytest.mark.parametrize("kind", [*SEPARABLE, "curvature_flow"])
def test_the_reference_keeps_a_tilted_plane_with_a_hole(fov, kind):
    view = ref.View(*SIZE, np.tan(np.radians(fov) / 2))
    a = view.affine(tilted_plane(view))
    radius = 12 * view.half_height / 96
    if kind == "curvature_flow":
        result = ref.curvature_flow(a, view, radius, 0.2, 2, 1.0)
    else:
        result = ref.smooth_depth(a, view, kind, radius, 0.2, 0.1)
        true = ref.smooth_plane(
            a, radius * view.scale(a), ref.depth_window(a, view, 0.2, 0.1), kind
        )
        assert np.array_equal(np.isnan(true), np.isnan(a))
        assert np.nanmax(np.abs(true / a - 1)) < 1e-12
    assert np.array_equal(np.isnan(result), np.isnan(a))
    assert np.nanmax(np.abs(result / a - 1)) < 1e-12


def test_the_gaussian_of_the_reference_is_the_true_one_separated():
    view = ref.View(*SIZE, 4.8, perspective=False)
    a = -np.random.default_rng(2).uniform(1, 2, SIZE[::-1])
    window = ref.depth_window(a, view, 1.0, 0.0)
    radius = np.full(a.shape, 5.0)
    true = ref.smooth_plane(a, radius, window, "gaussian")
    separate = ref.smooth_depth(a, view, "gaussian", 0.5, 1.0)
    inner = (slice(8, -8), slice(8, -8))
    # But for the corners of the square, which the disc does not have.
    assert np.abs(true - separate)[inner].mean() < 0.1 * np.abs(a - true)[inner].mean()


@pytest.mark.gl
@pytest.mark.parametrize("kind", [*SEPARABLE, "curvature_flow"])
@pytest.mark.parametrize("lens", [{"fov_y": 20}, {"fov_y": 90}, {"orthographic": True}])
def test_the_renderer_smooths_as_the_reference_does(kind, lens):
    """A crowd of sprites with steps and holes; float32 against float64."""
    camera = pbf.Camera(eye=(0, 0, 0), target=(0, 0, -1), height=1, **lens)
    view = view_of(camera)
    near = 0.5 / view.half_height if view.perspective else 1.0
    cloud = np.random.default_rng(4).uniform((-0.6, -0.4, -0.5), (0.6, 0.4, 0), (1500, 3))
    cloud[:, 2] -= near
    params = pbf.RenderParams(
        radius=RADIUS, smoothing=kind, smoothing_radius=0.05, smoothing_range=RANGE
    )
    with pbf.Renderer(*SIZE) as renderer:
        layers = renderer.layers(cloud, camera, params)
    a = view.affine(layers["depth"][::-1].astype(float))
    if kind == "curvature_flow":
        nearest = (-cloud[:, 2] - RADIUS).min()
        expected = ref.curvature_flow(a, view, 0.05, RANGE, 2, nearest)
    else:
        expected = a
        for _ in range(2):
            expected = ref.smooth_depth(expected, view, kind, 0.05, RANGE, RADIUS)
    got = layers["depth_smooth"][::-1]
    error = np.abs(got - view.depth(expected)) / RADIUS
    # Rounding decides here and there on which side of the range a neighbor is.
    assert np.mean(error > 1e-3) < 2e-3
    assert np.mean(error) < 1e-3
    moved = np.abs(got - layers["depth"]) / RADIUS
    assert moved.mean() > 0.02  # the filter did something


@pytest.mark.gl
@pytest.mark.parametrize("kind", [*SEPARABLE, "curvature_flow"])
@pytest.mark.parametrize("lens", [{"fov_y": 20}, {"fov_y": 80}, {"orthographic": True}])
def test_twice_the_resolution_shows_the_same_surface(kind, lens):
    camera = pbf.Camera(eye=(0, 0, 0), target=(0, 0, -1), height=1, **lens)
    near = 0.5 / view_of(camera).half_height if not camera.orthographic else 1.0
    block = pbf.block((-0.4, -0.3, -0.4), (0.4, 0.3, 0), spacing=RADIUS) - (0, 0, near)
    block += np.random.default_rng(5).normal(0, 0.1 * RADIUS, block.shape)
    params = pbf.RenderParams(radius=RADIUS, smoothing=kind)
    with pbf.Renderer(160, 120) as small, pbf.Renderer(320, 240) as large:
        one = small.layers(block, camera, params)["depth_smooth"]
        two = large.layers(block, camera, params)["depth_smooth"]
    two = two.reshape(120, 2, 160, 2).transpose(0, 2, 1, 3).reshape(120, 160, 4)
    seen = (one > 0) & (two > 0).all(axis=-1)
    assert seen.sum() > 4000
    error = np.abs(two.mean(axis=-1) - one)[seen] / RADIUS
    assert np.median(error) < 0.02
    assert error.mean() < 0.1
