"""Drops before one another and before a body of fluid, against spheres and what light can do."""

from __future__ import annotations

import numpy as np
import pytest
from support.optics import linear

import pbfluids as pbf

pytestmark = pytest.mark.gl

D = 0.02
WATER = {"radius": 1.2 * D, "drop_radius": 0.62 * D, "particle_volume": D**3}
CAMERA = pbf.Camera(eye=(0, 0, 2), target=(0, 0, 0), orthographic=True, height=12 * D)
BALL = np.stack(np.meshgrid(*[np.arange(-4, 5) * D] * 3), axis=-1).reshape(-1, 3)
BALL = BALL[np.linalg.norm(BALL, axis=1) < 3.6 * D]
#: Red, under a blue light.
OPAQUE = pbf.RenderParams(
    **WATER,
    absorption=(4000, 4000, 4000),
    scatter=(0.8, 0.2, 0.1),
    floor=False,
    reflection="plain",
    background_color=(0, 0, 1),
)


def test_a_drop_beside_others_stays_a_drop(renderer):
    # Six particles on each side, too far away to be joined, make the one between them a fifth
    # crowded.
    beside = [(1.9, 0, 0), *((2.7, y, z) for y in (-0.5, 0.5) for z in (-0.5, 0.5)), (3.5, 0, 0)]
    drops = np.concatenate([np.zeros((1, 3)), D * np.array(beside), -D * np.array(beside)])
    layers = renderer.layers(drops, CAMERA, pbf.RenderParams(**WATER))
    middle = slice(57, 63), slice(77, 83)
    front = layers["depth"][middle].min()
    radius = 2 - front
    assert 0.71 * D < radius < 0.80 * D
    # Two turns of a kernel with deviation s along both axes take 2 s^2/radius off a sphere's top; s
    # is a ninth of a body's.
    top = layers["depth_smooth"][middle].min()
    assert 0 < top - front < 1.1 * 2 * (1.2 * D / 9) ** 2 / radius


def test_a_body_is_as_dense_beside_a_drop_before_it(renderer):
    params = pbf.RenderParams(
        **WATER, absorption=(4000, 4000, 4000), floor=False, background="transparent"
    )
    at = 3.6 * D + WATER["radius"]
    drop = np.array([[at + 0.7 * D, 0, 60 * D]])
    alone = renderer.render(BALL, CAMERA, params)[..., 3]
    with_drop = renderer.render(np.concatenate([BALL, drop]), CAMERA, params)[..., 3]
    assert (alone == 255).sum() > 5000
    assert (with_drop[alone == 255] < 250).sum() <= 4  # where the outline has a corner


def test_through_an_opaque_drop_nothing_is_seen_of_what_it_hides(renderer):
    # A drop before the flank of a ball, which mirrors most of the light there.
    drop = np.array([[3.6 * D, 0, 15 * D]])
    alone = renderer.render(drop, CAMERA, OPAQUE).astype(int)
    before = renderer.render(np.concatenate([BALL, drop]), CAMERA, OPAQUE).astype(int)
    column = round(80 + 3.6 * D * 120 / (12 * D))
    seen = slice(58, 62), slice(column - 2, column + 2)
    assert np.abs(before[seen] - alone[seen]).max() <= 2


def test_the_rim_of_a_drop_mirrors_the_body_behind_it(renderer):
    # Opaque fluid under a blue light: where the mirrored ray goes on by more than 0.3 against the
    # body, the drop has nothing but the fluid's own color.
    look = OPAQUE.replace(background="plain", tone_mapping="none")
    body = pbf.block((-0.3, -0.3, -0.3), (0.3, 0.3, -0.1), spacing=D)
    camera = pbf.Camera(eye=(0, 0, 2), target=(0, 0, 0), orthographic=True, height=6 * D)
    light = linear(renderer.render(np.concatenate([body, [(0, 0, D)]]), camera, look))
    sine = (np.arange(80, 160) - 79.5) * 6 * D / 120 / WATER["drop_radius"]
    rim = light[60, 80:][(sine > 0.82) & (sine < 0.97)]
    assert rim[:, 2] == pytest.approx(rim[:, 0] / 8, abs=0.006)
    assert rim[:, 0].min() > 0.2
