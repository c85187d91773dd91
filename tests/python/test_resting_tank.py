"""A meter of water at rest stays a meter of water."""

from __future__ import annotations

import numpy as np
import pytest

import pbfluids as pbf

SPACING = 0.02  # m
DEPTH = 1.0  # m: fifty layers, each of which must hold up those above
LENGTH, WIDTH = 0.2, 0.16  # m
FRAME = 1 / 60  # s
# With the plain method a correction travels two support radii per iteration and compression falls
# with the square of the time step, so a deep tank needs short steps: 8 of 4 iterations lose 1.4 %.
SOLVERS = {"defaults": pbf.SolverParams(), "plain": pbf.SolverParams(substeps=16, iterations=2)}


@pytest.mark.slow
@pytest.mark.parametrize("solver", SOLVERS.values(), ids=SOLVERS)
def test_a_block_at_rest_one_meter_deep_keeps_its_volume_and_density_for_five_seconds(
    solver: pbf.SolverParams,
) -> None:
    """Volume within 1 %, by the mean height and by that of the surface; mean density as well."""
    tank = pbf.Box((0.0, 0.0, 0.0), (LENGTH, 1.2 * DEPTH, WIDTH))
    simulation = pbf.Simulation(pbf.FluidParams(spacing=SPACING), solver, domain=tank)
    simulation.add_particles(pbf.block((0.0, 0.0, 0.0), (LENGTH, DEPTH, WIDTH), spacing=SPACING))
    for _ in range(5):
        simulation.advance(FRAME, frames=60)
        heights = simulation.positions[:, 1].astype(np.float64)
        densities = simulation.densities.astype(np.float64)
        # The share p of a column lies below p times its height: the mean at half of it, all but two
        # percent below 98 %. The highest particles alone would tell of ripples.
        assert 2.0 * heights.mean() == pytest.approx(DEPTH, rel=0.01)
        assert np.quantile(heights, 0.98) / 0.98 == pytest.approx(DEPTH, rel=0.01)
        assert densities.mean() == pytest.approx(1000.0, rel=0.01)
    below_the_surface = heights < DEPTH - 2 * SPACING
    assert densities[below_the_surface].mean() == pytest.approx(1000.0, rel=0.005)
    assert simulation.time == pytest.approx(5.0, rel=1e-4)
    # Plain, it simmers at some 6 cm/s; a particle that fell freely through a spacing has 63 cm/s.
    assert np.linalg.norm(simulation.velocities, axis=1).mean() < 0.1  # m/s
