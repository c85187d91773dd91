"""Whole time steps of the compiled solver against the float64 reference."""

from __future__ import annotations

import math

import numpy as np
import pytest
import reference as ref
from numpy.typing import NDArray
from reference.samples import jittered_block

import pbfluids as pbf

D = 0.02  # spacing [m]
DT = float(np.float32(0.002))
STEPS = 20

ALL_TERMS = pbf.SolverParams(
    iterations=4,
    relaxation=0.01,
    constraint_floor=0.0,
    tensile_strength=0.02,
    vorticity=0.01,
    xsph=0.05,
    num_threads=1,
)


def run_both(
    fluid: pbf.FluidParams,
    solver: pbf.SolverParams,
    box: pbf.Box | None,
    x: NDArray[np.float64],
    v: NDArray[np.float64],
) -> tuple[pbf.Simulation, ref.State]:
    simulation = pbf.Simulation(fluid, solver, domain=box)
    simulation.add_particles(x, v)
    state = ref.State.at(simulation.positions, simulation.velocities)
    for _ in range(STEPS):
        simulation.step(DT)
        state = ref.step(state, ref.Fluid.of(fluid), ref.Solver.of(solver), ref.Box.of(box), DT)
    return simulation, state


def assert_same(simulation: pbf.Simulation, state: ref.State, start: NDArray[np.float64]) -> None:
    """Positions to d/1000, velocities to 1 mm/s, multipliers to 1e-5 / D_ideal.

    A step rounds positions of 0.3 m to 1.5e-8 m, and so velocities to 1e-5 m/s, which twenty steps
    add up to 1e-4 d. Collisions amplify that: the method is chaotic, and the reference started
    1e-8 m off leaves itself as fast. In these gentle scenes a tenth of the bounds is seen.
    """
    box = ref.Box.of(simulation.domain)
    way = np.linalg.norm(ref.nearest_image(state.x - start, box), axis=1)
    assert np.median(way) > 0.2 * D, "a scene in which nothing happens shows nothing"
    apart = ref.nearest_image(simulation.positions - state.x, box)
    np.testing.assert_allclose(apart, 0.0, rtol=0, atol=1e-3 * D)
    np.testing.assert_allclose(simulation.velocities, state.v, rtol=0, atol=1e-3)
    _, ideal = ref.calibration(ref.Fluid.of(simulation.fluid))
    scaled, expected = simulation.multipliers * ideal, state.multipliers * ideal
    np.testing.assert_allclose(scaled, expected, rtol=0, atol=1e-5)


@pytest.mark.parametrize("kernel", ["poly6_spiky", "cubic_spline", "wendland"])
def test_twenty_steps_of_a_dam_break_agree(kernel: str) -> None:
    """All terms on, against five walls; the block starts jittered and falls at 1 m/s."""
    fluid = pbf.FluidParams(spacing=D, kernel=kernel)
    box = pbf.Box((0.0, 0.0, 0.0), (16.3 * D, 20 * D, 8 * D))
    x = jittered_block((9, 9, 8), D, seed=40, share=0.1)
    v = np.tile([0.3, -1.0, 0.0], (len(x), 1))
    simulation, state = run_both(fluid, ALL_TERMS, box, x, v)
    assert_same(simulation, state, x)


def test_twenty_steps_of_colliding_drops_in_open_space_agree() -> None:
    fluid = pbf.FluidParams(spacing=D, gravity=(0.0, 0.0, 0.0))
    left = jittered_block(6, D, seed=41, share=0.1)
    right = jittered_block(6, D, seed=42, share=0.1) + D * np.array([6.5, 1.5, 0.5])
    x = np.vstack([left, right])
    v = np.repeat([[1.5, 0.0, 0.0], [-1.5, 0.0, 0.0]], [len(left), len(right)], axis=0)
    simulation, state = run_both(fluid, ALL_TERMS, None, x, v)
    assert_same(simulation, state, x)


def test_twenty_steps_of_the_two_sided_constraint_in_a_full_tank_agree() -> None:
    """Six walls and no free surface: the two-sided constraint makes one fall in on itself."""
    fluid = pbf.FluidParams(spacing=D, gravity=(1.0, -9.81, 2.0))
    solver = ALL_TERMS.replace(constraint_floor=-math.inf, relaxation=0.5)
    box = pbf.Box((0.1, -0.2, 0.0), (0.1 + 8 * D, -0.2 + 8 * D, 8 * D))
    x = jittered_block(8, D, seed=43, share=0.1) + np.array(box.lower)
    middle = x.mean(axis=0)
    v = 4.0 * np.cross([0.0, 0.0, 1.0], x - middle)
    simulation, state = run_both(fluid, solver, box, x, v)
    assert_same(simulation, state, x)


@pytest.mark.parametrize("kernel", ["poly6_spiky", "cubic_spline"])
def test_twenty_steps_of_a_dam_break_in_a_plane_agree(kernel: str) -> None:
    fluid = pbf.FluidParams(spacing=D, kernel=kernel, dimensions=2)
    box = pbf.Box((0.0, 0.0, 0.0), (26.3 * D, 30 * D, 1.0))
    x = jittered_block((16, 20, 1), D, seed=44, share=0.1)
    x[:, 2] = 0.3
    v = np.tile([0.3, -1.0, 0.0], (len(x), 1))
    simulation, state = run_both(fluid, ALL_TERMS, box, x, v)
    assert_same(simulation, state, x)


@pytest.mark.parametrize("kernel", ["poly6_spiky", "cubic_spline"])
@pytest.mark.parametrize("periodic", [(True, False, False), (True, False, True)])
def test_twenty_steps_of_a_wave_along_periodic_axes_agree(
    kernel: str, periodic: tuple[bool, bool, bool]
) -> None:
    """Fluid on a floor drifts through the seam; z is about as short as a period may be."""
    fluid = pbf.FluidParams(spacing=D, kernel=kernel, gravity=(2.0, -4.0, 1.0))
    box = pbf.Box((-0.1, 0.05, 0.3), (-0.1 + 9.4 * D, 0.3, 0.3 + 4.05 * D), periodic)
    x = jittered_block((9, 8, 4), D, seed=45, share=0.2) + np.array([-0.1, 0.05, 0.3])
    v = np.tile([0.8, -0.5, 0.5], (len(x), 1))
    simulation, state = run_both(fluid, ALL_TERMS, box, x, v)
    assert np.any(np.abs(simulation.positions - x) > 0.1), "some have crossed the seam"
    assert_same(simulation, state, x)


def test_twenty_steps_of_drops_that_collide_in_the_corner_of_a_periodic_plane_agree() -> None:
    fluid = pbf.FluidParams(spacing=D, gravity=(0.0, 0.0, 0.0), dimensions=2)
    box = pbf.Box((0.0, 0.0, 0.0), (30 * D, 25 * D, 1.0), (True, True, False))
    x = np.vstack([jittered_block((8, 8, 1), D, seed=seed, share=0.1) for seed in (46, 47)])
    x[:64] += [-8.3 * D, -4.0 * D, 0.0]
    x[64:] += [0.3 * D, -3.5 * D, 0.0]
    x[:, 2] = 0.5
    x = ref.wrap(x, ref.Box.of(box))
    v = np.repeat([[1.5, 0.3, 0.0], [-1.5, 0.3, 0.0]], 64, axis=0)
    simulation, state = run_both(fluid, ALL_TERMS, box, x, v)
    assert_same(simulation, state, x)
