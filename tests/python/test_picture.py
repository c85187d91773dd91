"""The finished picture: shadow, alpha, supersampling, tone, against closed forms and identities."""

from __future__ import annotations

import numpy as np
import pytest
from support.optics import fresnel, linear

import pbfluids as pbf
from pbfluids import errors

pytestmark = pytest.mark.gl

ALONG_Z = {"eye": (0, 0, 0), "target": (0, 0, -1)}
BLOCK = pbf.block((-0.3, -0.3, -2.3), (0.3, 0.3, -1.7), spacing=0.04)
DROPS = np.random.default_rng(1).uniform((-0.8, -0.6, -2.3), (0.8, 0.6, -1.7), (200, 3))
CLOUD = np.concatenate([BLOCK, DROPS])
WATER = {"radius": 0.048, "drop_radius": 0.0248, "particle_volume": 0.04**3}


def encoded(light):
    """SRGB, 0 to 255, not rounded."""
    light = np.asarray(light, float)
    curved = 1.055 * np.maximum(light, 1e-9) ** (1 / 2.4) - 0.055
    return 255 * np.where(light <= 0.0031308, 12.92 * light, curved)


def composited(image, color):
    """Lay a picture over a color, in linear light."""
    alpha = image[..., 3:] / 255
    return linear(image[..., :3]) * alpha + (1 - alpha) * np.asarray(color)


@pytest.mark.parametrize("color", [(0, 0, 0), (0.5, 0.5, 0.5), (0.2, 0.4, 0.7)])
@pytest.mark.parametrize("absorption", [(3, 3, 3), (7, 2, 1)])
def test_a_transparent_picture_over_a_color_is_the_picture_before_that_color(
    renderer, color, absorption
):
    camera = pbf.Camera(**ALONG_Z)
    params = pbf.RenderParams(
        **WATER, floor=False, reflection="plain", absorption=absorption, background_color=color
    )
    before = renderer.render(CLOUD, camera, params.replace(background="plain"))
    image = renderer.render(CLOUD, camera, params.replace(background="transparent"))
    assert image[0, 0].tolist() == [0, 0, 0, 0]
    assert 50 < image[60, 80, 3] < 255
    assert np.abs(encoded(composited(image, color)) - before[..., :3]).max() < 3


def test_gray_fluid_is_exact_over_any_color_and_bright_reflections_are_opaque(renderer):
    camera = pbf.Camera(**ALONG_Z)
    params = pbf.RenderParams(**WATER, floor=False, reflection="sky", absorption=(3, 3, 3))
    image = renderer.render(CLOUD, camera, params.replace(background="transparent"))
    for color in [(0.5, 0.5, 0.5), (0.2, 0.4, 0.7)]:
        plain = params.replace(background="plain", background_color=color)
        before = renderer.render(CLOUD, camera, plain)
        error = np.abs(encoded(composited(image, color)) - before[..., :3])
        # Where light is added to what is behind, the sum has no straight alpha: highlights, rims.
        assert np.quantile(error, 0.99) < 3


def test_a_floor_is_opaque_and_fades_into_transparency(renderer):
    camera = pbf.Camera(eye=(0, 0.5, 0), target=(0, 0.4, -1))
    image = renderer.render(
        np.zeros((0, 3)), camera, pbf.RenderParams(background="transparent", radius=0.05)
    )
    assert image[-1, 80, 3] == 255
    assert image[0, 80, 3] == 0
    assert (np.diff(image[:, 80, 3].astype(int)) >= 0).all()


@pytest.mark.parametrize("factor", [2, 3, 4])
def test_supersampling_is_the_mean_of_the_larger_picture_in_linear_light(renderer, backend, factor):
    camera, params = pbf.Camera(**ALONG_Z), pbf.RenderParams(**WATER, floor_height=-0.4)
    fine = renderer.render(CLOUD, camera, params.replace(supersampling=factor))
    with pbf.Renderer(160 * factor, 120 * factor, backend=backend) as larger:
        pixels = linear(larger.render(CLOUD, camera, params)[..., :3])
    mean = pixels.reshape(120, factor, 160, factor, 3).mean(axis=(1, 3))
    assert np.abs(fine[..., :3] - encoded(mean)).max() < 1


@pytest.mark.parametrize("color", [(0, 0, 0), (0.03, 0.2, 0.6), (0.79, 0.5, 0.001)])
def test_supersampling_leaves_flat_colors_as_they_are(renderer, color):
    camera = pbf.Camera(**ALONG_Z)
    params = pbf.RenderParams(background="plain", background_color=color, floor=False)
    once = renderer.render(np.zeros((0, 3)), camera, params)
    assert np.abs(once[0, 0, :3] - encoded(color)).max() < 0.7  # a driver's sRGB is not exact
    for factor in (2, 3, 4):
        image = renderer.render(np.zeros((0, 3)), camera, params.replace(supersampling=factor))
        assert np.array_equal(image, once)


def test_layers_and_later_pictures_do_not_depend_on_supersampling(renderer):
    camera, params = pbf.Camera(**ALONG_Z), pbf.RenderParams(**WATER)
    once = renderer.render(CLOUD, camera, params)
    layers = renderer.layers(CLOUD, camera, params)
    renderer.render(CLOUD, camera, params.replace(supersampling=2))
    again = renderer.layers(CLOUD, camera, params.replace(supersampling=2))
    assert all(np.array_equal(layers[name], again[name]) for name in layers)
    assert np.array_equal(renderer.render(CLOUD, camera, params), once)


@pytest.mark.parametrize("exposure", [0.5, 1.0, 3.0])
def test_tones_follow_their_formulas(renderer, exposure):
    light = np.array([0.1, 0.45, 0.95])
    x = light * exposure
    over = np.maximum(x - 0.8, 0)
    expected = {
        "none": np.minimum(x, 1),
        "soft": np.minimum(x, 0.8) + 0.2 * over / (over + 0.2),
        "aces": np.clip(x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14), 0, 1),
    }
    params = pbf.RenderParams(
        background="plain", background_color=light, floor=False, exposure=exposure
    )
    for name, tone in expected.items():
        image = renderer.render(
            np.zeros((0, 3)), pbf.Camera(**ALONG_Z), params.replace(tone_mapping=name)
        )
        assert np.abs(image[0, 0, :3] - encoded(tone)).max() < 0.7


def test_the_floor_below_a_slab_is_lit_by_what_the_slab_lets_through(renderer):
    # From below the slab, which the camera therefore does not see, straight down to the floor.
    slab = pbf.block((-0.6, 1.0, -0.6), (0.6, 1.2, 0.6), spacing=0.02)
    camera = pbf.Camera(eye=(0, 0.8, 0), target=(0, 0, 0), up=(0, 0, -1), fov_y=20)
    params = pbf.RenderParams(
        radius=0.024,
        particle_volume=0.02**3,
        absorption=(6, 2, 0),
        shadow=0.7,
        sun_direction=(0.3, 1, 0),
        floor_height=0,
    )
    lit = linear(renderer.render(slab, camera, params.replace(shadow=0))[..., :3])
    shaded = linear(renderer.render(slab, camera, params)[..., :3])
    way = 0.2 * np.hypot(0.3, 1)
    expected = 1 - 0.7 * (1 - np.exp(-np.array([6, 2, 0]) * way))
    ratio = (shaded / lit)[40:80, 60:100].mean(axis=(0, 1))
    assert ratio == pytest.approx(expected, abs=0.01)


def test_a_shadow_is_seen_in_what_fluid_mirrors_and_refracts(renderer):
    # A slab hangs over thin, clear fluid on the floor; the picture shows only the fluid.
    slab = pbf.block((-0.6, 1.0, -0.6), (0.6, 1.2, 0.6), spacing=0.02)
    film = pbf.block((-0.4, 0.0, -0.4), (0.4, 0.04, 0.4), spacing=0.02)
    camera = pbf.Camera(eye=(0, 0.8, 0), target=(0, 0, 0), up=(0, 0, -1), fov_y=20)
    params = pbf.RenderParams(
        radius=0.024, particle_volume=0.02**3, absorption=(6, 6, 6), scatter=(0, 0, 0)
    )
    cloud = np.concatenate([slab, film])
    lit = linear(renderer.render(cloud, camera, params.replace(shadow=0))[60, 80, 0])
    shaded = linear(renderer.render(cloud, camera, params.replace(shadow=1))[60, 80, 0])
    assert shaded < 0.5 * lit


def test_a_drop_at_the_glass_is_as_clear_as_in_the_open(renderer):
    camera = pbf.Camera(eye=(0, 0.5, 1), target=(0, 0.5, 0), fov_y=10)
    params = pbf.RenderParams(**WATER, background="plain", absorption=(9, 9, 9), floor=False)
    drop = [[0, 0.5, 0]]
    walls = {"tank_lower": (-2, 0, -2), "tank_upper": (0.021, 3, 0.021)}
    free = linear(renderer.render(drop, camera, params)[50:70, 70:78])
    assert linear(renderer.render(drop, camera, params.replace(**walls)))[50:70, 70:78] == (
        pytest.approx(free, abs=0.01)
    )


def test_through_a_drop_the_mirror_of_the_pool_behind_it_is_seen(renderer):
    # A pool so deep that it is black, before white: what is seen is mirrored, by the drop or by
    # the pool behind, which the drop takes a part of.
    pool = pbf.block((-1, -0.2, -3), (1, 0, 1), spacing=0.04)
    camera = pbf.Camera(eye=(0, 0.4, 1), target=(0, 0.15, 0), fov_y=20)
    params = pbf.RenderParams(
        **WATER, background="plain", absorption=(20, 20, 20), scatter=(0, 0, 0), floor=False
    )
    image = linear(renderer.render([*pool, (0, 0.15, 0)], camera, params))[..., 0]

    drop, behind = fresnel(1), fresnel(0.25 / np.hypot(0.25, 1))
    assert image[60, 40] == pytest.approx(behind, abs=0.03)
    behind *= np.exp(-20 * 2 * WATER["drop_radius"])
    assert image[59:61, 79:81].mean() == pytest.approx(drop + (1 - drop) * behind, abs=0.02)


@pytest.mark.parametrize("pixels", [5, 10, 20])
def test_the_suns_image_on_a_sphere_is_its_mean_over_the_pixel(renderer, pixels):
    # Less than a pixel wide, it would be a white speck or nothing by where its middle lies.
    radius, sun = 0.05, np.array([0.3, 0.4, 1])
    black = pbf.RenderParams(
        radius=radius,
        smoothing_iterations=0,
        background="plain",
        background_color=(0, 0, 0),
        reflection="sky",
        floor=False,
        absorption=(1e4, 1e4, 1e4),
        scatter=(0, 0, 0),
        tone_mapping="none",
        exposure=0.5,
        sun_direction=sun,
    )
    half = sun / np.linalg.norm(sun) + [0, 0, 1]
    place = radius * half[:2] / np.linalg.norm(half)

    def light(at, height):
        eye, target = (*at, 3), (*at, 0)
        camera = pbf.Camera(eye=eye, target=target, orthographic=True, height=height)
        return linear(renderer.render([[0, 0, 0]], camera, black))[..., 0]

    size = radius / pixels
    for shift in [(0, 0), (0.5, 0), (0, 0.5), (0.5, 0.5)]:
        at = place + size * np.array(shift)
        fine = light(at, 10 * size)[:, 20:140].reshape(10, 12, 10, 12).mean(axis=(1, 3))
        assert np.abs(light(at, 120 * size)[58:62, 78:82] - fine[3:7, 3:7]).max() < 0.06


@pytest.mark.parametrize(
    ("fields", "match"),
    [
        ({"supersampling": 0}, "RenderParams.supersampling = 0: must be"),
        ({"supersampling": 5}, "RenderParams.supersampling = 5: must be"),
        ({"tone_mapping": "film"}, 'RenderParams.tone_mapping .* "soft", "none", "aces"'),
        ({"background": "alpha"}, 'RenderParams.background .* "transparent"'),
        ({"reflection": "none"}, 'RenderParams.reflection .* "sky", "plain"'),
        ({"shadow": 1.5}, "RenderParams.shadow = 1.5: must be"),
    ],
)
def test_impossible_pictures_are_refused(fields, match):
    with pytest.raises(errors.InvalidParameter, match=match):
        pbf.RenderParams(**fields)


def test_a_picture_that_supersampling_makes_too_large_is_refused_and_changes_nothing(backend):
    camera, cloud = pbf.Camera(**ALONG_Z), [[0, 0, -1]]
    with pbf.Renderer(8192, 2, backend=backend) as wide:
        once = wide.render(cloud, camera)
        with pytest.raises(errors.InvalidParameter, match="with supersampling = 4"):
            wide.render(cloud, camera, pbf.RenderParams(supersampling=4))
        assert np.array_equal(wide.render(cloud, camera), once)
