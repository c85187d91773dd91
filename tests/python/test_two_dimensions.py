"""A fluid in a plane: ``FluidParams(dimensions=2)``."""

from __future__ import annotations

import copy
import re
from typing import Any

import numpy as np
import pytest
import reference as ref
from numpy.typing import NDArray
from reference.samples import bulk, jittered_block, lattice_block
from support.bits import hash_after_fifty_steps
from support.scenes import TINY, faults_of

import pbfluids as pbf
from pbfluids import errors
from pbfluids._core import stages

EPS = float(np.finfo(np.float32).eps)
D = 0.02  # spacing [m]
PLANE = 0.3  # z of the particles [m]
KERNELS = ["poly6_spiky", "cubic_spline"]
FLAT = pbf.FluidParams(spacing=D, dimensions=2)
ALL_TERMS = pbf.SolverParams(tensile_strength=0.02, vorticity=0.01, xsph=0.05)
TANK = pbf.Box((0.0, 0.0, 0.0), (0.6, 0.4, 1.0))

each_kernel = pytest.mark.parametrize("kernel", KERNELS)


def layer(n: int, m: int, seed: int | None = None, share: float = 0.1) -> NDArray[np.float64]:
    """n by m cells of the square lattice, jittered within the plane if there is a seed."""
    counts = (n, m, 1)
    x = lattice_block(counts, D) if seed is None else jittered_block(counts, D, seed, share)
    x[:, 2] = PLANE
    return x


def flat_dam_break(num_threads: int = 0) -> pbf.Simulation:
    simulation = pbf.Simulation(FLAT, ALL_TERMS.replace(num_threads=num_threads), domain=TANK)
    simulation.add_particles(pbf.block((0, 0, 0), (0.2, 0.3, 1.0), spacing=D, dimensions=2))
    return simulation


# --- kernels and the rest lattice ----------------------------------------------------------------


@each_kernel
@pytest.mark.parametrize("h", [0.05, 1.0, 3.0])
def test_the_reference_kernel_and_the_potential_of_its_gradient_integrate_to_one_over_the_plane(
    kernel: str, h: float
) -> None:
    """2 pi int W r dr = 1, and by parts -pi int (r . grad W) r dr = 1."""
    fluid = ref.Fluid(spacing=h / 2, support_radius=h, kernel=kernel, dimensions=2)
    nodes, weights = np.polynomial.legendre.leggauss(16)
    mass = gradient_mass = 0.0
    for lower in (0.0, h / 2):  # polynomials on each half
        r = h / 4 * (nodes + 1) + lower
        offsets = r[:, None] * np.array([0.6, 0.8, 0.0])
        W, grad_W = ref.kernel(fluid, offsets)
        mass += float(np.sum(h / 4 * weights * 2 * np.pi * r * W))
        along = np.sum(offsets * grad_W, axis=1)
        gradient_mass -= float(np.sum(h / 4 * weights * np.pi * r * along))
    assert mass == pytest.approx(1.0, rel=1e-12)
    assert gradient_mass == pytest.approx(1.0, rel=1e-12)


@each_kernel
@pytest.mark.parametrize("h_over_d", [1.5, 2.0, 2.5])
def test_kernel_and_calibration_agree_with_the_reference(kernel: str, h_over_d: float) -> None:
    fluid = FLAT.replace(kernel=kernel, support_radius=h_over_d * D)
    exact = ref.Fluid.of(fluid)
    assert stages.calibration(fluid) == pytest.approx(ref.calibration(exact), rel=1e-12)
    r = np.random.default_rng(70).uniform(-3 * D, 3 * D, (500, 3)).astype(np.float32)
    r[:, 2] = 0.0
    W, grad_W = ref.kernel(exact, r.astype(np.float64))
    got_W, got_grad_W = stages.kernel(fluid, r)
    np.testing.assert_allclose(got_W, W, rtol=0, atol=16 * EPS * W.max())
    np.testing.assert_allclose(got_grad_W, grad_W, rtol=0, atol=16 * EPS * np.abs(grad_W).max())


@each_kernel
def test_a_lattice_has_its_rest_density_and_ideal_denominator_inside(kernel: str) -> None:
    fluid = ref.Fluid(spacing=D, kernel=kernel, dimensions=2)
    x = layer(9, 9)
    volume, ideal = ref.calibration(fluid)
    assert volume == pytest.approx(D**2, rel=0.05)
    near = ref.find_neighbors(x, fluid)
    _, grad_W = ref.kernel(fluid, x[near.i] - x[near.j])
    inside = bulk(x[:, :2], D, 2 * D)
    assert inside.sum() == 25
    np.testing.assert_allclose(ref.operators.density(x, fluid, volume)[inside], 1.0, rtol=1e-12)
    denominators = near.sum(np.sum((volume * grad_W) ** 2, axis=1))
    np.testing.assert_allclose(denominators[inside], ideal, rtol=1e-12)

    params = FLAT.replace(kernel=kernel)
    simulation = pbf.Simulation(params)
    simulation.add_particles(x)
    np.testing.assert_allclose(simulation.densities[inside], 1000.0, rtol=16 * EPS)
    _, multipliers = stages.multipliers(x, params, pbf.SolverParams(), None)
    assert np.abs(multipliers[inside] * ideal).max() < 1e-5


@each_kernel
def test_a_lattice_that_fills_its_tank_has_its_rest_density_up_to_the_walls(kernel: str) -> None:
    """Lines of boundary particles continue the lattice beyond x and y; z has no walls."""
    box = pbf.Box((0.0, 0.0, 0.0), (0.2, 0.1, 0.01))
    simulation = pbf.Simulation(FLAT.replace(kernel=kernel), domain=box)
    simulation.add_particles(pbf.block(box.lower, box.upper, spacing=D, dimensions=2))
    assert len(simulation) == 50
    np.testing.assert_allclose(simulation.densities, 1000.0, rtol=16 * EPS)


def test_boundary_particles_are_those_of_the_reference() -> None:
    box = pbf.Box((-0.1, 0.05, 0.0), (0.03, 0.13, 1.0))  # x: 6.5 spacings
    x = (layer(6, 4, seed=71, share=0.4) + np.array([-0.1, 0.05, 0.0])).astype(np.float32)
    near = ref.find_neighbors(x.astype(np.float64), ref.Fluid.of(FLAT), ref.Box.of(box))
    offsets, q = stages.boundary_particles(x, FLAT, box)
    np.testing.assert_array_equal(q[:, 2], np.float32(PLANE))
    np.testing.assert_array_equal(np.diff(offsets), np.bincount(near.boundary_i, minlength=len(x)))
    i = np.repeat(np.arange(len(x)), np.diff(offsets))
    expected = near.sum_boundary(near.q[near.boundary_k])
    sums = np.stack([np.bincount(i, q[:, axis], len(x)) for axis in range(3)], axis=1)
    np.testing.assert_allclose(sums, expected, atol=1e-5)


# --- steps ---------------------------------------------------------------------------------------


def test_a_dam_break_stays_in_its_tank_and_in_its_plane() -> None:
    simulation = flat_dam_break()
    lower, upper = np.float32(TANK.lower), np.float32(TANK.upper)
    for _ in range(300):
        simulation.step(0.002)
        x = simulation.positions
        assert np.all((x >= lower) & (x <= upper))
        np.testing.assert_array_equal(x[:, 2], np.float32(0.5))
    np.testing.assert_array_equal(simulation.velocities[:, 2], 0.0)
    assert simulation.positions[:, 0].max() > 0.55, "the wave reached the far wall"


def test_the_state_has_the_same_bits_for_any_number_of_threads() -> None:
    once = hash_after_fifty_steps(flat_dam_break(1))
    for num_threads in (2, 3, 4, 7, 16):
        assert hash_after_fifty_steps(flat_dam_break(num_threads)) == once


# --- shapes --------------------------------------------------------------------------------------


def test_a_block_is_one_layer_midway_between_its_corners() -> None:
    x = pbf.block((0.0, 0.1, -0.25), (0.1, 0.2, 0.75), spacing=D, dimensions=2)
    assert x.shape == (25, 3)
    np.testing.assert_array_equal(x[:, 2], 0.25)
    solid = pbf.block((0.0, 0.1, 0.0), (0.1, 0.2, D), spacing=D)
    np.testing.assert_array_equal(x[:, :2], solid[:, :2])


def test_a_ball_is_a_disk_in_the_plane_of_its_center() -> None:
    x = pbf.ball((0.3, 0.2, 0.1), 0.2, spacing=D, dimensions=2)
    np.testing.assert_array_equal(x[:, 2], np.float32(0.1))
    assert np.linalg.norm(x - [0.3, 0.2, 0.1], axis=1).max() <= 0.2
    assert len(x) * D**2 == pytest.approx(np.pi * 0.2**2, rel=0.02)


# --- refusals ------------------------------------------------------------------------------------


@pytest.mark.parametrize("dimensions", [0, 1, 4])
def test_other_dimensions_are_refused(dimensions: int) -> None:
    with pytest.raises(errors.InvalidParameter, match=rf"dimensions = {dimensions}: must be"):
        pbf.FluidParams(dimensions=dimensions)
    with pytest.raises(errors.InvalidParameter, match=rf"dimensions = {dimensions}: must be"):
        pbf.block((0, 0, 0), (1, 1, 1), spacing=0.5, dimensions=dimensions)
    with pytest.raises(errors.InvalidParameter, match=rf"dimensions = {dimensions}: must be"):
        pbf.ball((0, 0, 0), 1.0, spacing=0.5, dimensions=dimensions)


def test_gravity_out_of_the_plane_is_refused() -> None:
    rule = r"FluidParams\.gravity = \(0, -9\.81, 1\) m/s\^2: z must be 0 in 2-D"
    with pytest.raises(errors.InvalidParameter, match=rule):
        pbf.FluidParams(dimensions=2, gravity=(0.0, -9.81, 1.0))
    params = pbf.FluidParams(gravity=(0.0, -9.81, 1.0))
    with pytest.raises(errors.InvalidParameter, match=rule):
        params.dimensions = 2
    assert params.dimensions == 3


@pytest.mark.parametrize(
    ("positions", "velocities", "message"),
    [
        ([[0.3, 0.1, 0.51]], None, "positions: particle 0 at (0.3, 0.1, 0.51) m; z must be 0.5 m"),
        ([[0.3, 0.1, 0.5], [0.4, 0.1, 0.0]], None, "positions: particle 1 at"),
        ([[0.3, 0.1, 0.5]], [[0, 0, 1]], "velocities: particle 0 at (0, 0, 1) m/s; z must be 0"),
        ([[0.7, 0.1, 0.5]], None, "is outside the domain"),
    ],
)
def test_particles_out_of_the_plane_are_refused_and_nothing_changes(
    positions: Any, velocities: Any, message: str
) -> None:
    simulation = flat_dam_break()
    simulation.step(0.002)
    before, count = simulation.state_hash(), len(simulation)
    with pytest.raises(errors.InvalidParameter, match=re.escape(message)):
        simulation.add_particles(positions, velocities)
    assert (simulation.state_hash(), len(simulation)) == (before, count)


def test_the_first_particle_decides_the_plane_be_it_within_z_of_the_domain_or_not() -> None:
    simulation = pbf.Simulation(FLAT, domain=TANK)
    with pytest.raises(errors.InvalidParameter, match=r"z must be 5 m, that of the first particle"):
        simulation.add_particles([[0.3, 0.1, 5.0], [0.4, 0.1, 0.0]])
    assert len(simulation) == 0
    simulation.add_particles([[0.3, 0.1, 5.0], [0.4, 0.1, 5.0]])
    simulation.step(0.002)
    np.testing.assert_array_equal(simulation.positions[:, 2], 5.0)


# --- scenes --------------------------------------------------------------------------------------


def flat_scene(**changes: Any) -> dict[str, Any]:
    data = copy.deepcopy(TINY)
    data["fluid"]["dimensions"] = 2
    return {**data, **changes}


def test_a_scene_in_2d_has_one_layer_of_each_shape() -> None:
    ball = {"center": [0.3, 0.3, 0.1], "radius": 0.08}
    scene = pbf.Scene(flat_scene(balls=[ball]))
    positions, _ = scene.particles()
    assert len(positions) == 16 + len(pbf.ball(**ball, spacing=0.05, dimensions=2))
    np.testing.assert_array_equal(positions[:, 2], np.float32(0.1))
    *_, last = scene.frames()
    np.testing.assert_array_equal(last.positions[:, 2], np.float32(0.1))
    assert pbf.Scene(scene.as_dict()) == scene


def test_z_of_a_flat_block_may_be_thinner_than_a_particle() -> None:
    block = {"lower": [0.0, 0.0, 0.1], "upper": [0.2, 0.2, 0.1]}
    assert len(pbf.Scene(flat_scene(blocks=[block])).particles()[0]) == 16


def test_what_does_not_fit_the_plane_of_a_scene_is_a_fault() -> None:
    blocks = [
        {"lower": [0.0, 0.0, 0.0], "upper": [0.2, 0.2, 0.2]},
        {"lower": [0.2, 0.0, 0.0], "upper": [0.4, 0.2, 0.1], "velocity": [0.0, 0.0, 1.0]},
        {"lower": [0.2, 0.2, 0.2], "upper": [0.4, 0.4, 0.0]},
        {"lower": [0.0, 0.1, 0.0], "upper": [0.2, 0.3, 0.2]},
    ]
    data = flat_scene(blocks=blocks)
    assert faults_of(data) == [
        "blocks[1]: its plane z = 0.05 m is not that of blocks[0], z = 0.1 m; in 2-D all fluid "
        "lies in one plane",
        "blocks[1].velocity[2] = 1 m/s: must be 0 in 2-D",
        "blocks[2].upper[2] = 0 m: must be >= lower[2] = 0.2 m",
        "blocks[3]: overlaps blocks[0] by 0.1 m; fluid cannot be there twice",
    ]
