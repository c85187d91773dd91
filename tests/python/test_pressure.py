"""The pressure method: against the float64 reference, and what it promises."""

from __future__ import annotations

import numpy as np
import pytest
import reference as ref
from numpy.typing import NDArray
from reference.samples import jittered_block

import pbfluids as pbf
from pbfluids import errors

D = 0.02  # spacing [m]
DT = float(np.float32(0.002))
G = 9.81


def tank(solver: pbf.SolverParams, **fluid: object) -> pbf.Simulation:
    """A column 20 spacings high and 8 wide, started on the rest lattice."""
    width, height = 8 * D, 20 * D
    simulation = pbf.Simulation(
        pbf.FluidParams(spacing=D, **fluid),
        solver,
        domain=pbf.Box((0, 0, 0), (width, 1.5 * height, width)),
    )
    simulation.add_particles(pbf.block((0, 0, 0), (width, height, width), spacing=D))
    return simulation


def kinetic_energy(simulation: pbf.Simulation) -> float:
    """Mean per mass [J/kg]."""
    return 0.5 * float(np.mean(np.sum(simulation.velocities.astype(float) ** 2, axis=1)))


@pytest.mark.parametrize(
    "solver",
    [
        pbf.SolverParams(),
        pbf.SolverParams(tolerance=1e-4, max_tolerance=2e-3, warm_start=0.8),
        pbf.SolverParams(compliance=1e-3, constraint_floor=0.0, tensile_strength=0.0),
        pbf.SolverParams(
            method="pressure", iterations=6, levels=1, acceleration="none", vorticity=0.01
        ),
        pbf.SolverParams(max_iterations=3, constraint_floor=-np.inf),
    ],
    ids=["defaults", "tight", "soft", "counted", "capped, two-sided"],
)
def test_twenty_steps_of_a_dam_break_agree_with_the_reference(solver: pbf.SolverParams) -> None:
    box = pbf.Box((0.0, 0.0, 0.0), (16.3 * D, 20 * D, 8 * D))
    x = jittered_block((9, 9, 8), D, seed=40, share=0.1)
    v = np.tile([0.3, -1.0, 0.0], (len(x), 1))
    simulation = pbf.Simulation(pbf.FluidParams(spacing=D), solver, domain=box)
    simulation.add_particles(x, v)
    fluid, terms = ref.Fluid.of(simulation.fluid), ref.Solver.of(solver)
    assert fluid.kernel == "wendland"
    state = ref.State.at(simulation.positions, simulation.velocities)
    for _ in range(20):
        report = simulation.step(DT)
        state = ref.step(state, fluid, terms, ref.Box.of(box), DT)
        # An error within rounding of the tolerance may cost an iteration here and not there.
        assert abs(report.iterations - state.iterations) <= 1
    np.testing.assert_allclose(simulation.positions, state.x, rtol=0, atol=1e-3 * D)
    np.testing.assert_allclose(simulation.velocities, state.v, rtol=0, atol=2e-3)
    near = ref.find_neighbors(state.x, fluid, ref.Box.of(box))
    expected = ref.virial_pressures(state.x, state.totals, near, fluid, DT)
    np.testing.assert_allclose(
        simulation.pressures, expected, rtol=0, atol=5e-3 * np.abs(expected).max()
    )


def test_one_step_agrees_to_rounding() -> None:
    x = jittered_block((7, 7, 7), D, seed=44, share=0.15)
    simulation = pbf.Simulation(
        pbf.FluidParams(spacing=D, gravity=(0, 0, 0)),
        pbf.SolverParams(method="pressure", iterations=12, xsph=0.0),
    )
    simulation.add_particles(x)
    start = ref.State.at(simulation.positions, simulation.velocities)
    simulation.step(DT)
    fluid = ref.Fluid.of(simulation.fluid)
    state = ref.step(start, fluid, ref.Solver.of(simulation.solver), None, DT)
    np.testing.assert_allclose(simulation.positions, state.x, rtol=0, atol=2e-5 * D)
    near = ref.find_neighbors(state.x, fluid)
    expected = ref.virial_pressures(state.x, state.totals, near, fluid, DT)
    np.testing.assert_allclose(
        simulation.pressures, expected, rtol=0, atol=1e-4 * np.abs(expected).max()
    )


@pytest.mark.parametrize("compliance", [0.0, 1e-3], ids=["stiff", "soft"])
@pytest.mark.parametrize(
    ("periodic", "dimensions"),
    [((False, False, False), 3), ((True, False, True), 3), ((False, False, False), 2)],
    ids=["walls", "periodic", "2-D"],
)
def test_the_coarse_level_agrees_with_the_reference(
    periodic: tuple[bool, bool, bool], dimensions: int, compliance: float
) -> None:
    """A column that the floor stops: seven cells and a half of the grid in one step."""
    fluid_params = pbf.FluidParams(spacing=D, gravity=(0, -G, 0), dimensions=dimensions)
    solver = pbf.SolverParams(method="pressure", iterations=1, compliance=compliance, xsph=0.0)
    box = pbf.Box((0, 0, 0), (13 * D, 30 * D, 7 * D), periodic=periodic)
    x = jittered_block((13, 20, 7 if dimensions == 3 else 1), D, seed=45, share=0.1)
    x[:, 1] *= 0.99
    if dimensions == 2:
        x[:, 2] = 0.0
    positions, totals = {}, {}
    for levels in (1, 2):
        simulation = pbf.Simulation(fluid_params, solver.replace(levels=levels), domain=box)
        simulation.add_particles(x)
        fluid, terms = ref.Fluid.of(simulation.fluid), ref.Solver.of(simulation.solver)
        state = ref.State.at(simulation.positions, simulation.velocities)
        simulation.step(DT)
        positions[levels] = simulation.positions
        totals[levels] = simulation.pressures.max()
        expected = ref.step(state, fluid, terms, ref.Box.of(box), DT)
        np.testing.assert_allclose(simulation.positions, expected.x, rtol=0, atol=1e-4 * D)
    assert np.abs(positions[2] - positions[1]).max() > 1e-2 * D
    assert totals[2] > 2 * totals[1]


def test_the_step_is_one_over_the_largest_eigenvalue_of_the_lattice() -> None:
    for kernel, ratio in [("poly6_spiky", 2.0), ("cubic_spline", 1.5), ("wendland", 2.5)]:
        fluid = ref.Fluid(spacing=D, support_radius=ratio * D, kernel=kernel)
        simulation = pbf.Simulation(
            pbf.FluidParams(spacing=D, support_radius=ratio * D, kernel=kernel, gravity=(0, 0, 0)),
            pbf.SolverParams(
                method="pressure", iterations=1, levels=1, relaxation=0.0, tensile_strength=0.0
            ),
        )
        # Two particles close together: C, its gradients and so the multiplier in closed form.
        simulation.add_particles([[0, 0, 0], [0.1 * D, 0, 0]])
        simulation.step(DT)
        x = np.array([[0, 0, 0], [0.1 * D, 0, 0]], np.float32).astype(np.float64)
        C, grad2 = ref.density_constraint(x, ref.find_neighbors(x, fluid), fluid)
        expected = np.minimum(-C / grad2 / ref.largest_eigenvalue(fluid), 0)
        np.testing.assert_allclose(simulation.multipliers, expected, rtol=1e-3)


def column_after(seconds: float, solver: pbf.SolverParams) -> pbf.Simulation:
    simulation = tank(solver)
    simulation.advance(1 / 60, frames=round(60 * seconds))
    return simulation


def test_a_column_comes_to_rest_under_its_hydrostatic_pressure() -> None:
    simulation = column_after(2.0, pbf.SolverParams())
    x, v = simulation.positions, simulation.velocities
    density = simulation.densities / 1000
    height = 20 * D
    top = np.sort(x[:, 1])[-64:].mean() + D / 2
    assert top == pytest.approx(height, rel=0.012)  # the free layer closes up by a quarter of D
    assert np.mean(density) == pytest.approx(1, abs=0.002 + 0.01)  # and is less dense by nature
    inside = x[:, 1] < height - 3 * D
    assert np.mean(density[inside]) == pytest.approx(1, abs=0.002)
    assert np.mean(density[x[:, 1] < D]) == pytest.approx(1, abs=0.02)
    at_walls = inside & ((x[:, [0, 2]] < D) | (x[:, [0, 2]] > 7 * D)).any(axis=1)
    assert np.mean(density[at_walls]) == pytest.approx(1, abs=0.02)
    assert np.mean(np.sum(v**2, axis=1)) < 1e-3

    # Away from the walls, whose boundary particles have no pressure of their own to hold with; by
    # layers, since the pressures of single particles are as uneven as their neighborhoods.
    inner = inside & ~at_walls & (x[:, 1] > D)
    layer = (x[:, 1] / D).astype(int)
    layers = np.unique(layer[inner])
    p = np.array([simulation.pressures[inner & (layer == k)].mean() for k in layers], float)
    y = np.array([x[inner & (layer == k), 1].mean() for k in layers], float)
    assert np.corrcoef(y, p)[0, 1] ** 2 > 0.99
    slope, bottom = np.polyfit(y, p, 1)
    assert slope == pytest.approx(-1000 * G, rel=0.1)
    assert bottom == pytest.approx(1000 * G * top, rel=0.1)


def test_with_two_levels_a_few_counted_iterations_hold_a_column() -> None:
    def density(levels: int) -> float:
        simulation = column_after(
            1.0, pbf.SolverParams(method="pressure", iterations=2, levels=levels)
        )
        inside = simulation.positions[:, 1] < 16 * D
        return float(np.mean(simulation.densities[inside])) / 1000

    assert density(2) == pytest.approx(1, abs=0.002)
    assert density(1) > 1.02


def test_with_compliance_the_settled_density_is_that_of_the_pressure() -> None:
    """rho / rho0 - 1 = compliance p / rho0, for any time step."""
    compliance = 5e-3  # 2 % at the bottom of 0.4 m
    means = []
    for substeps in (1, 2, 4):
        solver = pbf.SolverParams(substeps=substeps, compliance=compliance, xsph=0.05)
        simulation = column_after(2.0, solver)
        inside = simulation.positions[:, 1] < 0.3
        means.append(float(np.mean(simulation.densities[inside])) / 1000)
    y = simulation.positions[inside, 1].astype(float)
    expected = 1 + compliance * G * float(np.mean(0.4 - y))
    assert means == pytest.approx([expected] * len(means), abs=0.002)


def test_the_iterations_end_at_the_tolerance_and_not_before_the_least() -> None:
    loose = tank(pbf.SolverParams(tolerance=0.5, min_iterations=3))
    assert loose.step(1 / 240).iterations == 3
    capped = tank(pbf.SolverParams(tolerance=1e-9, max_iterations=7))
    assert capped.step(1 / 240).iterations == 7
    counted = tank(pbf.SolverParams(method="pressure", iterations=5))
    assert counted.step(1 / 240).iterations == 5
    fine = tank(pbf.SolverParams(tolerance=1e-4, max_iterations=500))
    mean = fine.step(1 / 240).mean_density_error
    assert mean < 1.1e-4
    worst = tank(pbf.SolverParams(max_tolerance=5e-4, max_iterations=500))
    assert worst.step(1 / 240).max_density_error < 6e-4


def test_the_worst_particle_of_a_dam_break_stays_within_its_tolerance() -> None:
    def worst(**changes: float) -> float:
        side, tank_of = 0.3, (0.9, 0.6, 0.3)
        simulation = pbf.Simulation(
            pbf.FluidParams(spacing=0.02),
            pbf.SolverParams(**changes),
            domain=pbf.Box((0,) * 3, tank_of),
        )
        simulation.add_particles(pbf.block((0,) * 3, (side,) * 3, 0.02))
        return max(simulation.step(1 / 240).max_density_error for _ in range(120))

    assert worst(max_tolerance=99) > 0.04
    assert worst() < 0.03 + 1e-5


def test_a_warm_start_in_long_steps_is_bounded_as_in_the_reference() -> None:
    """Steps of 1/30 s: shares of the last pressures would push by several spacings."""
    dt = float(np.float32(1 / 30))
    box = pbf.Box((0.0, 0.0, 0.0), (6 * D, 20 * D, 6 * D))
    solver = pbf.SolverParams(warm_start=0.8, levels=1, max_iterations=40, xsph=0.0)
    simulation = pbf.Simulation(pbf.FluidParams(spacing=D), solver, domain=box)
    simulation.add_particles(pbf.block((0, 0, 0), (6 * D, 12 * D, 6 * D), D))
    fluid, terms = ref.Fluid.of(simulation.fluid), ref.Solver.of(solver)
    state = ref.State.at(simulation.positions, simulation.velocities)
    bounded = 0
    for _ in range(4):
        bounded += 0.8 * np.abs(state.totals).max() > 0.5 * D**2
        simulation.step(dt)
        state = ref.step(state, fluid, terms, ref.Box.of(box), dt)
    assert bounded >= 2
    np.testing.assert_allclose(simulation.positions, state.x, rtol=0, atol=2e-3 * D)


@pytest.mark.parametrize("warm_start", [0.25, 0.8])
def test_deep_water_holds_in_steps_of_a_whole_frame(warm_start: float) -> None:
    """√(gH) dt / d = 1.6, where half of the last pressures throws the surface up by a spacing."""
    simulation = tank(pbf.SolverParams(warm_start=warm_start, substeps=1))
    for _ in range(40):
        report = simulation.advance(1 / 60)
    assert report.stable
    assert kinetic_energy(simulation) < 1e-3
    assert 2 * simulation.positions[:, 1].mean() > 0.99 * 20 * D


def test_momentum_of_iterations_needs_fewer_of_them() -> None:
    def iterations(**changes: object) -> int:
        solver = pbf.SolverParams(max_iterations=2000, warm_start=0.0).replace(**changes)
        return tank(solver).advance(1 / 60).iterations

    assert iterations() < 0.5 * iterations(acceleration="none")
    calm = tank(pbf.SolverParams(warm_start=0.0))
    warm = tank(pbf.SolverParams(warm_start=0.5))
    for simulation in (calm, warm):
        simulation.advance(1 / 60, frames=30)
    assert warm.advance(1 / 60).iterations < calm.advance(1 / 60).iterations


def state_after_steps(threads: int) -> tuple[str, NDArray[np.float32]]:
    simulation = tank(pbf.SolverParams(num_threads=threads))
    simulation.advance(1 / 60, frames=3)
    return simulation.state_hash(), simulation.pressures


def test_any_number_of_threads_gives_the_same_bits() -> None:
    expected_hash, expected = state_after_steps(1)
    for threads in (2, 3, 4, 7, 16):
        found_hash, pressures = state_after_steps(threads)
        assert found_hash == expected_hash
        np.testing.assert_array_equal(pressures, expected)


def test_drops_that_collide_keep_their_momentum() -> None:
    fluid = pbf.FluidParams(spacing=D, gravity=(0, 0, 0))
    simulation = pbf.Simulation(fluid)
    left = pbf.ball((0, 0, 0), 0.1, spacing=D)
    right = pbf.ball((0.22, 0.06, 0), 0.1, spacing=D)
    simulation.add_particles(left, np.tile([1.0, 0, 0], (len(left), 1)))
    simulation.add_particles(right, np.tile([-1.0, 0, 0], (len(right), 1)))
    before = simulation.velocities.astype(np.float64).sum(axis=0)
    for _ in range(100):
        simulation.step(1 / 240)
    v = simulation.velocities.astype(np.float64)
    assert np.linalg.norm(v.sum(axis=0) - before) < 1e-6 * np.linalg.norm(v, axis=1).sum()


def test_particles_that_come_free_carry_no_pressure_along() -> None:
    simulation = column_after(0.5, pbf.SolverParams())
    assert simulation.pressures.max() > 2000
    simulation.solver = simulation.solver.replace(warm_start=1.0)
    drop = simulation.add_particles([[0.08, 0.55, 0.08]])
    simulation.step(1 / 240)
    assert simulation.pressures[drop[0]] == pytest.approx(0, abs=1)


def test_pressures_are_zero_before_the_first_step_and_scale_with_the_time_step() -> None:
    simulation = tank(pbf.SolverParams())
    np.testing.assert_array_equal(simulation.pressures, 0)
    simulation.advance(1 / 60, frames=30)
    at_rest = float(np.mean(simulation.pressures))
    for _ in range(20):
        simulation.step(1 / 480)
    assert float(np.mean(simulation.pressures)) == pytest.approx(at_rest, rel=0.1)


def test_an_adaptive_time_step_follows_the_fastest_particle() -> None:
    adaptive = pbf.SolverParams(time_step="adaptive", cfl=0.4, max_time_step=4e-3)
    calm, fast = tank(adaptive), tank(adaptive)
    assert calm.advance(1 / 50).steps == 5  # 20 ms in steps of at most 4 ms
    fast.add_particles([[0.08, 0.5, 0.08]], [[0, -8.0, 0]])
    report = fast.advance(1 / 50)
    assert 18 <= report.steps <= 26  # 0.4 * 0.02 m / 8 m/s = 1 ms
    assert fast.time == pytest.approx(1 / 50, rel=1e-6)
    floor = tank(adaptive.replace(min_time_step=3e-3))
    floor.add_particles([[0.08, 0.5, 0.08]], [[0, -8.0, 0]])
    assert floor.advance(1 / 50).steps <= 7


def test_rules_that_span_parameters_are_checked() -> None:
    for changes in ({"min_iterations": 200}, {"min_time_step": 1.0}):
        simulation = tank(pbf.SolverParams())
        (name,) = changes
        with pytest.raises(errors.InvalidParameter, match=f"SolverParams.{name} = "):
            simulation.solver = pbf.SolverParams().replace(**changes)


def test_the_method_follows_from_counting_iterations_and_the_kernel_from_the_method() -> None:
    def kernel(solver: pbf.SolverParams) -> str | None:
        return pbf.Simulation(pbf.FluidParams(), solver).fluid.kernel

    assert kernel(pbf.SolverParams()) == "wendland"
    assert kernel(pbf.SolverParams(iterations=4)) == "poly6_spiky"
    assert kernel(pbf.SolverParams(method="pressure", iterations=4)) == "wendland"
    chosen = pbf.FluidParams(kernel="cubic_spline")
    assert pbf.Simulation(chosen).fluid.kernel == "cubic_spline"


def test_an_unstable_time_step_says_so() -> None:
    stable = tank(pbf.SolverParams())
    assert stable.step(1 / 240).stable
    simulation = tank(pbf.SolverParams(iterations=1, tensile_strength=5.0))
    with pytest.warns(errors.UnstableTimeStep, match="the time step is too long; use shorter ones"):
        reports = [simulation.step(0.1) for _ in range(3)]
    assert not reports[-1].stable
