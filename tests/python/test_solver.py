"""What the solver must do whatever the numbers: conserve, contain, repeat itself, refuse."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
import reference as ref
from numpy.typing import NDArray
from reference.samples import bulk, jittered_block, lattice_block
from support.bits import hash_after_fifty_steps

import pbfluids as pbf
from pbfluids import _core, errors
from pbfluids._core import stages

EPS = float(np.finfo(np.float32).eps)
D = 0.02  # spacing [m]
H = 2 * D  # support radius [m]
WEIGHTLESS = pbf.FluidParams(spacing=D, gravity=(0.0, 0.0, 0.0))
ALL_TERMS = pbf.SolverParams(tensile_strength=0.02, vorticity=0.01, xsph=0.05)


def two_drops(speed: float) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Two balls that meet a little off center, a gap of one spacing between them."""
    ball = pbf.ball((0.0, 0.0, 0.0), 4 * D, spacing=D)
    x = np.vstack([ball, ball + D * np.array([9.0, 2.0, 0.0])])
    v = np.repeat([[speed, 0.0, 0.0], [-speed, 0.0, 0.0]], len(ball), axis=0)
    return x, v


def small_dam_break(num_threads: int = 0) -> pbf.Simulation:
    box = pbf.Box((0.0, 0.0, 0.0), (0.6, 0.4, 0.2))
    simulation = pbf.Simulation(
        pbf.FluidParams(spacing=D), ALL_TERMS.replace(num_threads=num_threads), domain=box
    )
    simulation.add_particles(pbf.block((0.0, 0.0, 0.0), (0.2, 0.3, 0.2), spacing=D))
    return simulation


# --- conservation --------------------------------------------------------------------------------


@pytest.mark.parametrize("xsph", [0.0, 0.05])
@pytest.mark.parametrize("distance", [0.0, 2.0])
def test_colliding_drops_in_open_space_conserve_momentum(xsph: float, distance: float) -> None:
    """|sum v - sum v at the start| <= 1e-6 sum |v| in 100 steps, near and far from the origin."""
    x, v = two_drops(speed=1.0)
    x += distance
    simulation = pbf.Simulation(WEIGHTLESS, pbf.SolverParams(tensile_strength=0.02, xsph=xsph))
    simulation.add_particles(x, v)
    start = simulation.velocities.sum(axis=0, dtype=np.float64)
    for _ in range(100):
        simulation.step(0.002)
        now = simulation.velocities.astype(np.float64)
        drift = np.linalg.norm(now.sum(axis=0) - start)
        assert drift <= 1e-6 * np.linalg.norm(now, axis=1).sum()
    left = simulation.velocities[: len(x) // 2, 0]
    assert left.mean() < 0.8, "the drops did meet"


def test_a_step_of_free_flight_moves_the_center_of_mass_by_its_velocity() -> None:
    x, v = two_drops(speed=0.5)
    v += [0.25, -0.5, 1.0]
    simulation = pbf.Simulation(WEIGHTLESS)
    simulation.add_particles(x, v)
    for _ in range(50):
        simulation.step(0.002)
    expected = x.mean(axis=0) + 0.1 * v.mean(axis=0)
    got = simulation.positions.mean(axis=0, dtype=np.float64)
    np.testing.assert_allclose(got, expected, atol=1e-6 * 0.1)


def test_one_particle_falls_by_the_recurrence_of_the_integrator() -> None:
    """Symplectic Euler: x_n = x_0 + n dt v_0 + g dt^2 n (n + 1) / 2, to the roundings of x."""
    n, dt = 50, 0.004
    x0, v0 = np.array([[0.1, 0.5, -0.2]]), np.array([[1.0, 2.0, -0.5]])
    simulation = pbf.Simulation(pbf.FluidParams(spacing=D))
    simulation.add_particles(x0, v0)
    for _ in range(n):
        simulation.step(dt)
    g = np.array([0.0, -9.81, 0.0])
    # A step rounds x by EPS/4 m at 0.5 m, v by EPS/4 m / dt; n of each add up at random.
    np.testing.assert_allclose(simulation.velocities[0], v0[0] + n * dt * g, atol=n * EPS / 4 / dt)
    expected = x0[0] + n * dt * v0[0] + g * dt**2 * n * (n + 1) / 2
    np.testing.assert_allclose(simulation.positions[0], expected, atol=n**1.5 * EPS / 4)
    assert simulation.time == pytest.approx(n * dt, rel=1e-6)
    assert simulation.step_count == n


def test_particles_out_of_reach_of_each_other_fly_straight() -> None:
    x = H * np.stack(np.meshgrid(*[np.arange(5) * 1.5] * 3), axis=-1).reshape(-1, 3)
    simulation = pbf.Simulation(WEIGHTLESS, ALL_TERMS)
    simulation.add_particles(x, np.tile([0.5, 0.25, -1.0], (len(x), 1)))
    for _ in range(10):
        simulation.step(0.01)
    np.testing.assert_allclose(
        simulation.positions, x + np.array([0.05, 0.025, -0.1]), atol=20 * EPS
    )


def test_a_rigidly_rotating_ball_has_the_vorticity_two_omega_inside() -> None:
    """The solver's plain curl times 1/M, the lattice's first moment; the corrected one as it is."""
    ball = pbf.ball((0.0, 0.0, 0.0), 6 * D, spacing=D)
    rate = np.array([1.0, -2.0, 3.0])
    v = np.cross(rate, ball)
    inside = np.linalg.norm(ball, axis=1) < 6 * D - H - D / 2
    assert inside.sum() > 100
    for kernel in ("poly6_spiky", "cubic_spline", "wendland"):
        fluid = WEIGHTLESS.replace(kernel=kernel)
        volume, _ = stages.calibration(fluid)
        lattice = ref.lattice(float(np.float32(D)), 2 * H)
        M = ref.operators.moment(lattice, ref.Fluid.of(fluid), volume)[len(lattice) // 2, 0, 0]
        plain = stages.vorticity(ball, v, fluid)[inside]
        np.testing.assert_allclose(plain, np.tile(2 * M * rate, (len(plain), 1)), atol=1e-4)
        assert abs(M - 1.0) < 0.055
        corrected = pbf.operators.curl(v, ball, support_radius=H, kernel=kernel, corrected=True)
        expected = np.tile(2 * rate, (inside.sum(), 1))
        np.testing.assert_allclose(corrected[inside], expected, atol=1e-4)


# --- walls ---------------------------------------------------------------------------------------


@pytest.mark.filterwarnings("ignore::pbfluids.errors.UnstableTimeStep")
def test_no_particle_leaves_the_box_however_hard_it_is_thrown() -> None:
    box = pbf.Box((-0.1, 0.2, 0.3), (0.17, 0.5, 0.53))  # sizes that D does not divide
    fluid = pbf.FluidParams(spacing=D, gravity=(0.0, -9.81, 0.0))
    simulation = pbf.Simulation(fluid, ALL_TERMS, domain=box)
    x = pbf.block((-0.1, 0.2, 0.3), (0.1, 0.4, 0.5), spacing=D)
    directions = np.random.default_rng(60).normal(size=x.shape)
    v = 20.0 * directions / np.linalg.norm(directions, axis=1, keepdims=True)
    simulation.add_particles(x, v)
    lower, upper = np.float32(box.lower), np.float32(box.upper)
    for _ in range(200):
        simulation.step(0.004)
        now = simulation.positions
        assert np.all((now >= lower) & (now <= upper))


def test_a_block_on_the_lattice_has_its_rest_density_up_to_the_walls() -> None:
    """Boundary particles continue the lattice: faces, edges and corners, floor to rim."""
    box = pbf.Box((0.0, 0.0, 0.0), (0.2, 0.2, 0.2))
    for kernel in ("poly6_spiky", "cubic_spline", "wendland"):
        simulation = pbf.Simulation(pbf.FluidParams(spacing=D, kernel=kernel), domain=box)
        simulation.add_particles(pbf.block(box.lower, box.upper, spacing=D))
        np.testing.assert_allclose(simulation.densities, 1000.0, rtol=16 * EPS)


def test_the_first_layer_at_a_wall_settles_at_its_rest_density() -> None:
    """Within 5 %, for floor and side walls, once a jittered block has come to rest."""
    box = pbf.Box((0.0, 0.0, 0.0), (0.2, 0.3, 0.2))
    solver = pbf.SolverParams(xsph=0.1)
    simulation = pbf.Simulation(pbf.FluidParams(spacing=D), solver, domain=box)
    jitter = 0.1 * D * np.random.default_rng(61).uniform(-1, 1, (1000, 3))
    x = np.clip(pbf.block((0.0, 0.0, 0.0), (0.2, 0.2, 0.2), spacing=D) + jitter, 0.0, 0.2)
    simulation.add_particles(x)
    for _ in range(500):
        simulation.step(1 / 500)
    settled, densities = simulation.positions, simulation.densities
    below_surface = settled[:, 1] < 0.2 - 2 * H
    to_side = np.minimum(settled, np.float32(0.2) - settled)[:, [0, 2]].min(axis=1)
    for layer in (settled[:, 1] < D, (to_side < D) & below_surface):
        assert layer.sum() > 50
        assert densities[layer].mean() == pytest.approx(1000.0, rel=0.05)


# --- the same result, always ---------------------------------------------------------------------


def test_the_state_has_the_same_bits_for_any_number_of_threads() -> None:
    once = hash_after_fifty_steps(small_dam_break(1))
    for num_threads in (2, 3, 4, 7, 16):
        assert hash_after_fifty_steps(small_dam_break(num_threads)) == once


def test_the_state_has_the_same_bits_for_any_instruction_set(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    hashes = set()
    for isa in _core.instruction_sets():
        monkeypatch.setenv("PBF_ISA", isa)
        hashes.add(hash_after_fifty_steps(small_dam_break()))
    assert len(hashes) == 1


def test_an_unknown_instruction_set_is_refused_and_changes_nothing(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    simulation = small_dam_break()
    before = simulation.state_hash()
    monkeypatch.setenv("PBF_ISA", "mmx")
    with pytest.raises(errors.InvalidParameter, match='PBF_ISA = "mmx": must be one of'):
        simulation.step(0.002)
    assert simulation.state_hash() == before


def test_a_frame_is_its_substeps() -> None:
    frame, steps = small_dam_break(), small_dam_break()
    report = frame.advance(1 / 64)  # a power of two divides without rounding
    for _ in range(frame.solver.substeps):
        steps.step(1 / 64 / frame.solver.substeps)
    assert frame.state_hash() == steps.state_hash()
    assert report.steps == frame.solver.substeps
    assert report.iterations >= frame.solver.substeps * frame.solver.min_iterations


def test_the_hash_knows_every_part_of_the_state() -> None:
    simulation = small_dam_break()
    seen = {simulation.state_hash()}
    simulation.step(0.002)
    seen.add(simulation.state_hash())
    simulation.add_particles([[0.5, 0.3, 0.1]])
    seen.add(simulation.state_hash())
    at_rest, moving = pbf.Simulation(WEIGHTLESS), pbf.Simulation(WEIGHTLESS)
    at_rest.add_particles(np.zeros((1, 3)))
    moving.add_particles(np.zeros((1, 3)), [[0.0, 1e-3, 0.0]])
    seen |= {at_rest.state_hash(), moving.state_hash()}
    assert len(seen) == 5


# --- few particles, and their identity -----------------------------------------------------------


@pytest.mark.parametrize("box", [None, pbf.Box((0.0, 0.0, 0.0), (0.2, 0.2, 0.2))])
def test_an_empty_simulation_steps(box: pbf.Box | None) -> None:
    simulation = pbf.Simulation(pbf.FluidParams(spacing=D), ALL_TERMS, domain=box)
    report = simulation.step(0.002)
    assert report.mean_density_error == report.max_density_error == 0.0
    assert len(simulation) == 0
    assert simulation.positions.shape == simulation.velocities.shape == (0, 3)
    assert simulation.densities.shape == simulation.multipliers.shape == (0,)
    assert simulation.step_count == 1
    assert simulation.add_particles(np.empty((0, 3))).shape == (0,)


@pytest.mark.parametrize("n", range(1, 71))
def test_any_small_number_of_particles_stays_finite(n: int) -> None:
    """Every remainder of vector widths and chunks, and particles close enough to fight."""
    box = pbf.Box((0.0, 0.0, 0.0), (0.1, 0.1, 0.1))
    simulation = pbf.Simulation(pbf.FluidParams(spacing=D), ALL_TERMS, domain=box)
    simulation.add_particles(np.random.default_rng(n).uniform(0.0, 0.1, (n, 3)))
    for _ in range(5):
        simulation.step(0.002)
    for values in (simulation.positions, simulation.velocities, simulation.densities):
        assert len(values) == n
        assert np.all(np.isfinite(values))


def test_rows_keep_their_particles_though_the_solver_sorts_them() -> None:
    """Scattered particles, each on a straight way of its own: row i ends where row i must."""
    rng = np.random.default_rng(62)
    x = H * 2.0 * np.stack(np.meshgrid(*[np.arange(6.0)] * 3), axis=-1).reshape(-1, 3)
    x = x[rng.permutation(len(x))]
    v = rng.uniform(-0.1, 0.1, x.shape)
    simulation = pbf.Simulation(WEIGHTLESS)
    ids = simulation.add_particles(x, v)
    for _ in range(20):
        simulation.step(0.01)
    np.testing.assert_array_equal(ids, np.arange(len(x)))
    np.testing.assert_array_equal(simulation.ids, ids)
    np.testing.assert_allclose(simulation.positions, x + 0.2 * v, atol=40 * EPS)
    np.testing.assert_allclose(simulation.velocities, v, atol=40 * EPS / 0.01)


def test_adding_particles_appends_rows_and_leaves_the_others() -> None:
    simulation = small_dam_break()
    for _ in range(10):
        simulation.step(0.002)
    before = len(simulation)
    x, v = simulation.positions, simulation.velocities
    added = np.array([[0.5, 0.3, 0.1], [0.4, 0.35, 0.15]], dtype=np.float32)
    ids = simulation.add_particles(added, [[0.0, -1.0, 0.0], [1.0, 0.0, 0.0]])
    np.testing.assert_array_equal(ids, [before, before + 1])
    np.testing.assert_array_equal(simulation.positions, np.vstack([x, added]))
    np.testing.assert_array_equal(simulation.velocities[:before], v)
    np.testing.assert_array_equal(simulation.velocities[before:], [[0, -1, 0], [1, 0, 0]])
    simulation.step(0.002)
    assert len(simulation) == before + 2


def test_arrays_are_copies_that_a_step_does_not_change() -> None:
    simulation = small_dam_break()
    x = simulation.positions
    kept = x.copy()
    simulation.step(0.002)
    np.testing.assert_array_equal(x, kept)
    simulation.positions[:] = 0.0
    assert np.any(simulation.positions != 0.0)


def test_the_report_and_the_densities_tell_the_same() -> None:
    simulation = small_dam_break()
    for _ in range(20):
        report = simulation.step(0.002)
    excess = np.maximum(simulation.densities.astype(np.float64) / 1000.0 - 1.0, 0.0)
    # The report uses the neighbors found at the predicted positions, the densities those of now.
    assert report.max_density_error == pytest.approx(excess.max(), rel=0.05)
    assert report.mean_density_error == pytest.approx(excess.mean(), rel=0.05)
    assert report.steps == 1
    assert set(report.milliseconds) >= {"predict", "neighbors", "multipliers", "corrections"}
    assert report.total_milliseconds == pytest.approx(sum(report.milliseconds.values()))


# --- refusals ------------------------------------------------------------------------------------


@pytest.mark.parametrize("dt", [0.0, -0.001, float("nan"), float("inf"), 1e-50])
def test_a_time_step_that_is_not_finite_and_positive_is_refused(dt: float) -> None:
    simulation = small_dam_break()
    before = simulation.state_hash()
    with pytest.raises(errors.InvalidParameter, match="dt"):
        simulation.step(dt)
    assert simulation.state_hash() == before


@pytest.mark.parametrize(
    ("positions", "velocities", "named"),
    [
        (np.zeros(3), None, "positions"),
        (np.zeros((2, 2)), None, "positions"),
        ([[0.1, np.nan, 0.1]], None, "positions"),
        ([[0.1, np.inf, 0.1]], None, "positions"),
        ([[0.1, 1e300, 0.1]], None, "positions"),
        ([[0.1, 0.41, 0.1]], None, "domain"),
        ([[-1e-6, 0.1, 0.1]], None, "domain"),
        ([[0.1, 0.1, 0.1]], np.zeros((2, 3)), "velocities"),
        ([[0.1, 0.1, 0.1]], [[0.0, np.nan, 0.0]], "velocities"),
    ],
)
def test_particles_that_break_a_rule_are_refused_and_nothing_changes(
    positions: Any, velocities: Any, named: str
) -> None:
    simulation = small_dam_break()
    simulation.step(0.002)
    before, count = simulation.state_hash(), len(simulation)
    with pytest.raises(errors.InvalidParameter, match=named):
        simulation.add_particles(positions, velocities)
    assert simulation.state_hash() == before
    assert len(simulation) == count


@pytest.mark.parametrize("positions", ["water", None, [["a", "b", "c"]], np.zeros((1, 3), complex)])
def test_positions_that_are_not_real_numbers_are_a_type_error(positions: Any) -> None:
    simulation = small_dam_break()
    before = simulation.state_hash()
    with pytest.raises(errors.WrongType, match="positions"):
        simulation.add_particles(positions)
    assert simulation.state_hash() == before


def test_a_step_that_fails_leaves_the_state_before_it() -> None:
    """Particles flung beyond what float32 tells apart; the next step, after mending, works."""
    simulation = pbf.Simulation(WEIGHTLESS)
    x = lattice_block(4, D)
    simulation.add_particles(x)
    simulation.step(0.002)
    simulation.add_particles([[1.0, 1.0, 1.0]], [[1e30, 0.0, 0.0]])
    before, kept = simulation.state_hash(), simulation.positions
    with pytest.raises(errors.SimulationFailed):
        simulation.step(0.002)
    assert simulation.state_hash() == before
    np.testing.assert_array_equal(simulation.positions, kept)
    assert simulation.step_count == 1
    assert np.all(np.isfinite(simulation.densities))


def test_too_many_particles_in_one_place_fail_with_an_error_that_says_so() -> None:
    simulation = pbf.Simulation(WEIGHTLESS)
    simulation.add_particles(np.zeros((20_000, 3)))
    before = simulation.state_hash()
    with pytest.raises(errors.SimulationFailed, match="neighbors"):
        simulation.step(0.002)
    assert simulation.state_hash() == before


def test_inside_the_bulk_a_calm_block_in_open_space_does_not_move() -> None:
    """C = 0, so nothing pushes until the free surface's news arrives, 2h per iteration at most."""
    x = lattice_block(13, D)
    simulation = pbf.Simulation(WEIGHTLESS, pbf.SolverParams(iterations=1, tensile_strength=0.0))
    simulation.add_particles(x)
    simulation.step(0.002)
    moved = np.abs(simulation.positions - x.astype(np.float32))[bulk(x, D, 2 * H)]
    assert moved.max() < 1e-5 * D
    jittered = jittered_block(13, D, seed=63)
    other = pbf.Simulation(WEIGHTLESS, pbf.SolverParams(iterations=1))
    other.add_particles(jittered)
    other.step(0.002)
    assert np.abs(other.positions - jittered).max() > 1e-3 * D
