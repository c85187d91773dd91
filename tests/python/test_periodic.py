"""Periodic axes: ``Box(lower, upper, periodic=(True, False, False))``."""

from __future__ import annotations

import copy
from typing import Any

import numpy as np
import pytest
import reference as ref
from numpy.typing import NDArray
from reference.samples import jittered_block
from support.bits import hash_after_fifty_steps
from support.scenes import TINY, faults_of

import pbfluids as pbf
from pbfluids import _core, errors, toml

EPS = float(np.finfo(np.float32).eps)
D = 0.02  # spacing [m]
H = 2 * D  # support radius [m]
WEIGHTLESS = pbf.FluidParams(spacing=D, gravity=(0.0, 0.0, 0.0))
ALL_TERMS = pbf.SolverParams(tensile_strength=0.02, vorticity=0.01, xsph=0.05)
EVERYWHERE = (True, True, True)
SIDE = 0.6  # of the cube below [m]
CUBE = pbf.Box((0.0, 0.0, 0.0), (SIDE, SIDE, SIDE), EVERYWHERE)

each_kernel = pytest.mark.parametrize("kernel", ["poly6_spiky", "cubic_spline"])


def apart(a: Any, b: Any, box: pbf.Box = CUBE) -> NDArray[np.float64]:
    """a - b to the nearest image."""
    return ref.nearest_image(np.asarray(a, np.float64) - b, ref.Box.of(box))


def channel(num_threads: int = 0, dimensions: int = 3) -> pbf.Simulation:
    """Fluid over a floor that is blown through the seam of x, and of z where there is one."""
    box = pbf.Box((-0.1, 0.0, 0.2), (0.2, 0.4, 0.36), (True, False, dimensions == 3))
    wind = (5.0, -9.81, 3.0 if dimensions == 3 else 0.0)
    fluid = pbf.FluidParams(spacing=D, gravity=wind, dimensions=dimensions)
    simulation = pbf.Simulation(fluid, ALL_TERMS.replace(num_threads=num_threads), domain=box)
    x = pbf.block((-0.1, 0.0, 0.2), (0.1, 0.2, 0.36), spacing=D, dimensions=dimensions)
    simulation.add_particles(x, np.tile([1.0, 0.0, 0.0], (len(x), 1)))
    return simulation


# --- the rest lattice ----------------------------------------------------------------------------


@each_kernel
@pytest.mark.parametrize("periodic", [EVERYWHERE, (True, False, False), (False, True, True)])
@pytest.mark.parametrize("h_over_d", [1.5, 2.0, 3.0])
def test_a_lattice_that_fills_the_box_has_its_rest_density_everywhere(
    kernel: str, periodic: tuple[bool, bool, bool], h_over_d: float
) -> None:
    """Across the seams, and where a seam meets a wall; z is a shortest period at h = 3 d."""
    box = pbf.Box((-0.1, 0.05, 0.3), (0.1, 0.21, 0.42), periodic)
    fluid = WEIGHTLESS.replace(kernel=kernel, support_radius=h_over_d * D * (1 - 1e-6))
    simulation = pbf.Simulation(fluid, domain=box)
    simulation.add_particles(pbf.block(box.lower, box.upper, spacing=D))
    assert len(simulation) == 480
    np.testing.assert_allclose(simulation.densities, 1000.0, rtol=16 * EPS)


@each_kernel
@pytest.mark.parametrize("dimensions", [2, 3])
def test_a_lattice_that_fills_the_box_stays_at_rest(kernel: str, dimensions: int) -> None:
    """Sums cancel, so a step moves by roundings only.

    The lattice is no stable equilibrium: with the default solver roundings grow from step to step,
    with walls as without. Relaxation and XSPH damp them.
    """
    box = pbf.Box((0.0, 0.0, 0.0), (8 * D, 8 * D, 8 * D), (True, True, dimensions == 3))
    fluid = WEIGHTLESS.replace(kernel=kernel, dimensions=dimensions)
    x = pbf.block(box.lower, box.upper, spacing=D, dimensions=dimensions)
    for solver, steps in ((ALL_TERMS, 1), (pbf.SolverParams(relaxation=1.0, xsph=1.0), 100)):
        simulation = pbf.Simulation(fluid, solver, domain=box)
        simulation.add_particles(x)
        for _ in range(steps):
            simulation.step(0.002)
        assert np.abs(apart(simulation.positions, x, box)).max() < 1e-5 * D
        np.testing.assert_allclose(simulation.densities, 1000.0, rtol=1e-5)


@pytest.mark.parametrize("dimensions", [2, 3])
def test_a_box_full_of_fluid_falls_freely_round_and_round(dimensions: int) -> None:
    """The displacement, and so the velocity, knows nothing of the seam."""
    box = pbf.Box((0.0, 0.0, 0.0), (8 * D, 8 * D, 8 * D), (True, True, dimensions == 3))
    fluid = pbf.FluidParams(spacing=D, dimensions=dimensions)
    solver = pbf.SolverParams(relaxation=1.0, xsph=1.0)
    simulation = pbf.Simulation(fluid, solver, domain=box)
    x = pbf.block(box.lower, box.upper, spacing=D, dimensions=dimensions)
    simulation.add_particles(x)
    n, dt = 200, 0.002
    for _ in range(n):
        simulation.step(dt)
    np.testing.assert_allclose(simulation.velocities[:, 1], -9.81 * n * dt, rtol=1e-4)
    way = -9.81 * dt**2 * n * (n + 1) / 2
    assert way < -4 * 8 * D, "several times round"
    moved = apart(simulation.positions, x + np.array([0.0, way, 0.0]), box)
    assert np.abs(moved).max() < 0.01 * D


# --- across the seam -----------------------------------------------------------------------------


def flown(
    center: list[float], steps: int, solver: pbf.SolverParams = ALL_TERMS
) -> tuple[pbf.Simulation, NDArray[np.float64]]:
    """A stirred drop on its way through the cube, and where it started."""
    x = pbf.ball((0.0, 0.0, 0.0), 4 * D, spacing=D) + np.array(center)
    rng = np.random.default_rng(80)
    x += 0.2 * D * rng.uniform(-1, 1, x.shape)
    v = [1.5, -1.0, 0.5] + 0.5 * rng.normal(size=x.shape)
    simulation = pbf.Simulation(WEIGHTLESS, solver, domain=CUBE)
    simulation.add_particles(ref.wrap(x, ref.Box.of(CUBE)), v)
    for _ in range(steps):
        simulation.step(0.002)
    return simulation, x


@pytest.mark.parametrize("center", [[0.58, 0.3, 0.3], [0.0, 0.0, 0.0], [0.59, 0.02, 0.55]])
def test_a_drop_that_crosses_a_face_an_edge_or_a_corner_moves_like_one_that_does_not(
    center: list[float],
) -> None:
    """To float32's rounding of 0.6 m, 3e-8 m a step, which twenty steps of collisions amplify."""
    inside, start = flown([0.3, 0.3, 0.3], steps=20)
    crossing, crossing_start = flown(center, steps=20)
    way = apart(inside.positions, start)
    assert np.linalg.norm(way, axis=1).mean() > 2 * D
    np.testing.assert_allclose(apart(crossing.positions, crossing_start), way, atol=1e-3 * D)
    np.testing.assert_allclose(crossing.velocities, inside.velocities, atol=1e-3)
    np.testing.assert_allclose(crossing.densities, inside.densities, rtol=1e-3)
    left = np.ptp(inside.positions, axis=0).max()
    assert np.ptp(crossing.positions, axis=0).max() > 2 * left, "it did lie across the seam"


def test_each_velocity_stage_sees_across_the_seam_what_the_one_before_it_wrote() -> None:
    """Confinement that changes velocities by some 0.1 m/s, of which XSPH takes over half."""
    solver = ALL_TERMS.replace(vorticity=2.0, xsph=0.5)
    inside, _ = flown([0.3, 0.3, 0.3], steps=1, solver=solver)
    crossing, _ = flown([0.0, 0.0, 0.0], steps=1, solver=solver)
    np.testing.assert_allclose(crossing.velocities, inside.velocities, atol=1e-3)
    without, _ = flown([0.3, 0.3, 0.3], steps=1, solver=solver.replace(vorticity=0.0))
    assert np.abs(inside.velocities - without.velocities).mean() > 0.02


def test_collisions_across_the_seams_conserve_momentum() -> None:
    """|sum v - sum v at the start| <= 1e-6 sum |v| in 100 steps, as in open space."""
    half = pbf.ball((0.0, 0.0, 0.0), 4 * D, spacing=D)
    x = np.vstack([half + np.array([-0.05, 0.0, 0.59]), half + np.array([0.13, 0.03, 0.0])])
    v = np.repeat([[1.0, 0.2, 0.0], [-1.0, 0.2, 0.0]], len(half), axis=0)
    simulation = pbf.Simulation(WEIGHTLESS, pbf.SolverParams(xsph=0.05), domain=CUBE)
    simulation.add_particles(ref.wrap(x, ref.Box.of(CUBE)), v)
    start = simulation.velocities.sum(axis=0, dtype=np.float64)
    for _ in range(100):
        simulation.step(0.002)
        now = simulation.velocities.astype(np.float64)
        drift = np.linalg.norm(now.sum(axis=0) - start)
        assert drift <= 1e-6 * np.linalg.norm(now, axis=1).sum()
    assert simulation.velocities[: len(half), 0].mean() < 0.8, "the drops did meet"


def test_every_position_is_inside_after_every_step() -> None:
    """Upper faces excluded along periodic axes, walls at work along the other."""
    simulation = channel()
    lower, upper = np.float32(simulation.domain.lower), np.float32(simulation.domain.upper)
    speeds = 20.0 * np.random.default_rng(81).normal(size=(200, 3))
    above = jittered_block((10, 5, 4), D, seed=82) + np.array([-0.1, 0.22, 0.21])
    simulation.add_particles(above, speeds)
    for _ in range(200):
        simulation.step(0.004)
        x = simulation.positions
        assert np.all((x >= lower) & (x <= upper))
        assert np.all(x[:, [0, 2]] < upper[[0, 2]])


def test_a_lone_particle_flies_straight_through_all_faces() -> None:
    simulation = pbf.Simulation(WEIGHTLESS, ALL_TERMS, domain=CUBE)
    v = np.array([[3.0, -2.0, 40.0]])  # along z 0.08 m a step
    simulation.add_particles([[0.3, 0.1, 0.5]], v)
    for _ in range(500):
        simulation.step(0.002)
    np.testing.assert_allclose(simulation.velocities, v, rtol=2 * EPS)
    expected = np.array([[0.3, 0.1, 0.5]]) + v
    np.testing.assert_allclose(apart(simulation.positions, expected), 0.0, atol=500 * EPS)


def test_the_upper_face_of_a_periodic_axis_is_the_lower_one() -> None:
    simulation = pbf.Simulation(WEIGHTLESS, domain=CUBE)
    simulation.add_particles([[SIDE, 0.1, SIDE]])
    np.testing.assert_array_equal(simulation.positions, np.float32([[0.0, 0.1, 0.0]]))


# --- a flow --------------------------------------------------------------------------------------


def test_taylor_green_vortices_decay_and_stay_nearly_free_of_divergence() -> None:
    """v = (sin x cos y, -cos x sin y) in a plane that is periodic both ways.

    Viscosity would make it weaker and leave its shape. The divergence is measured by the solver's
    kernel sum, against the vorticity by the same; the start has 5 % for its jitter.
    """
    side, n = 1.0, 32
    fluid = pbf.FluidParams(
        spacing=side / n, gravity=(0.0, 0.0, 0.0), kernel="cubic_spline", dimensions=2
    )
    box = pbf.Box((0.0, 0.0, 0.0), (side, side, 1.0), (True, True, False))
    x = jittered_block((n, n, 1), side / n, seed=83)
    x[:, 2] = 0.5

    def taylor_green(x: NDArray[np.float64]) -> NDArray[np.float64]:
        a, b = 2 * np.pi * x[:, 0], 2 * np.pi * x[:, 1]
        return np.stack([np.sin(a) * np.cos(b), -np.cos(a) * np.sin(b), 0 * a], axis=1)

    exact, bounds = ref.Fluid.of(fluid), ref.Box.of(box)
    volume, _ = ref.calibration(exact)
    simulation = pbf.Simulation(fluid, domain=box)
    simulation.add_particles(x, taylor_green(x))
    momentum = simulation.velocities.sum(axis=0, dtype=np.float64)
    energy = np.sum(simulation.velocities.astype(np.float64) ** 2)
    for _ in range(5):
        for _ in range(50):
            simulation.step(0.002)
        x, v = simulation.positions.astype(np.float64), simulation.velocities.astype(np.float64)
        assert np.all((x[:, :2] >= 0.0) & (x[:, :2] < side))
        assert np.linalg.norm(v.sum(axis=0) - momentum) <= 1e-5 * np.abs(v).sum()
        assert 0.5 * energy < np.sum(v**2) < 0.95 * energy
        energy = np.sum(v**2)
        shape = taylor_green(x)
        assert np.sum(v * shape) > 0.9 * np.sqrt(energy * np.sum(shape**2))
        near = ref.find_neighbors(x, exact, bounds)
        _, grad_W = ref.kernel(exact, near.r(x))
        divergence = volume * near.sum(np.sum((v[near.j] - v[near.i]) * grad_W, axis=1))
        vorticity = ref.vorticity(x, v, near, exact)[:, 2]
        assert np.std(divergence) < 0.08 * np.std(vorticity)
        np.testing.assert_allclose(simulation.densities, 1000.0, rtol=0.03)


# --- the same result, always ---------------------------------------------------------------------


@pytest.mark.parametrize("dimensions", [2, 3])
def test_the_state_has_the_same_bits_for_any_number_of_threads(dimensions: int) -> None:
    once = hash_after_fifty_steps(channel(1, dimensions))
    for num_threads in (2, 3, 4, 7, 16):
        assert hash_after_fifty_steps(channel(num_threads, dimensions)) == once


def test_the_state_has_the_same_bits_for_any_instruction_set(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    hashes = set()
    for isa in _core.instruction_sets():
        monkeypatch.setenv("PBF_ISA", isa)
        hashes.add(hash_after_fifty_steps(channel()))
    assert len(hashes) == 1


@pytest.mark.parametrize("n", [0, 1, 2, 15, 16, 17, 31, 33])
def test_any_small_number_of_particles_steps(n: int) -> None:
    """Every remainder of vector widths, behind which the ghosts begin."""
    box = pbf.Box((0.0, 0.0, 0.0), (0.08, 0.1, 0.09), EVERYWHERE)
    simulation = pbf.Simulation(WEIGHTLESS, ALL_TERMS, domain=box)
    simulation.add_particles(np.random.default_rng(n).uniform(0.0, 0.08, (n, 3)))
    for _ in range(5):
        simulation.step(0.002)
    for values in (simulation.positions, simulation.velocities, simulation.densities):
        assert len(values) == n
        assert np.all(np.isfinite(values))


# --- refusals ------------------------------------------------------------------------------------


@pytest.mark.parametrize("axis", [0, 1, 2])
def test_a_period_of_less_than_two_support_radii_is_refused(axis: int) -> None:
    upper = [1.0, 1.0, 1.0]
    upper[axis] = 0.079
    periodic = [k == axis for k in range(3)]
    pbf.Simulation(WEIGHTLESS, domain=pbf.Box((0, 0, 0), upper))
    box = pbf.Box((0, 0, 0), upper, periodic)
    rule = rf"domain: its period of 0\.079 m along {'xyz'[axis]} must be >= 0\.08 m \(2 support"
    with pytest.raises(errors.InvalidParameter, match=rule):
        pbf.Simulation(WEIGHTLESS, domain=box)


def test_a_periodic_z_is_refused_in_2d() -> None:
    rule = r"domain: periodic = \(true, true, true\); z must be false in 2-D"
    with pytest.raises(errors.InvalidParameter, match=rule):
        pbf.Simulation(WEIGHTLESS.replace(dimensions=2), domain=CUBE)


@pytest.mark.parametrize("periodic", [True, (True, False), (True, False, "x"), "xyz", None])
def test_periodic_takes_three_times_true_or_false(periodic: Any) -> None:
    with pytest.raises(errors.WrongType, match=r"Box\.periodic = .*: expected true or false three"):
        pbf.Box((0, 0, 0), (1, 1, 1), periodic)


def test_a_position_outside_is_refused_along_periodic_axes_as_well() -> None:
    simulation = channel()
    before = simulation.state_hash()
    with pytest.raises(errors.InvalidParameter, match="outside the domain"):
        simulation.add_particles([[0.21, 0.1, 0.3]])
    assert simulation.state_hash() == before


def test_a_particle_flung_beyond_what_float32_tells_apart_fails_and_changes_nothing() -> None:
    simulation = channel()
    simulation.step(0.002)
    simulation.add_particles([[0.1, 0.3, 0.3]], [[1e30, 0.0, 0.0]])
    before, kept = simulation.state_hash(), simulation.positions
    with pytest.raises(errors.SimulationFailed):
        simulation.step(0.002)
    assert simulation.state_hash() == before
    np.testing.assert_array_equal(simulation.positions, kept)


# --- scenes --------------------------------------------------------------------------------------


def test_a_scene_may_have_periodic_axes() -> None:
    data = copy.deepcopy(TINY)
    assert pbf.Scene(data).domain.periodic == (False, False, False)
    data["domain"]["periodic"] = [True, False, True]
    scene = pbf.Scene(data)
    assert scene.domain.periodic == (True, False, True)
    assert pbf.Scene(toml.loads(scene.to_toml())) == scene
    *_, last = scene.replace(gravity=(5.0, -9.81, 0.0)).frames()
    assert np.all(last.positions[:, 0] < np.float32(0.4))


@pytest.mark.parametrize(
    ("domain", "fault"),
    [
        ({"periodic": [True, False]}, "domain.periodic = [true, false]: must have 3 values"),
        ({"periodic": [1, 0, 0]}, "domain.periodic[0] = 1: must be true or false"),
        ({"upper": [0.4, 0.4, 0.19], "periodic": [False, False, True]}, "domain: its period of"),
    ],
)
def test_a_scene_whose_periodic_axes_break_a_rule_says_so(
    domain: dict[str, Any], fault: str
) -> None:
    data = copy.deepcopy(TINY)
    data["domain"] |= domain
    data["blocks"][0]["upper"] = [0.2, 0.2, 0.15]
    found = faults_of(data)
    assert found[0].startswith(fault)
