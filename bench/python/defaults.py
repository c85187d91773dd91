"""What the solver's defaults are chosen from: three small cases, one parameter at a time.

    python bench/python/defaults.py [--seconds 2]

prints a Markdown table for docs/defaults.md. Only the last column depends on the machine.
"""

from __future__ import annotations

import argparse
import math
import time
from collections.abc import Callable

import numpy as np

import pbfluids as pbf

SPACING = 0.02
FRAME = 1 / 60

VARIANTS: dict[str, dict[str, float]] = {
    "as chosen": {},
    "constraint_floor = 0": {"constraint_floor": 0.0},
    "constraint_floor = -0.01": {"constraint_floor": -0.01},
    "constraint_floor = -inf": {"constraint_floor": -math.inf},
    "tensile_strength = 0": {"tensile_strength": 0.0},
    "tensile_strength = 0.01": {"tensile_strength": 0.01},
    "tensile_strength = 0.05": {"tensile_strength": 0.05},
    "relaxation = 0.1": {"relaxation": 0.1},
    "xsph = 0": {"xsph": 0.0},
}


def resting(solver: pbf.SolverParams, seconds: float) -> list[str]:
    """A column 1 m deep: change of volume, mean density, fastest particle."""
    side, depth = 0.2, 1.0
    tank = pbf.Box((0, 0, 0), (side, 1.5 * depth, side))
    sim = pbf.Simulation(pbf.FluidParams(spacing=SPACING), solver, domain=tank)
    sim.add_particles(pbf.block((0, 0, 0), (side, depth, side), SPACING))
    before = sim.positions[:, 1].mean()
    sim.advance(FRAME, frames=round(seconds / FRAME))
    volume = sim.positions[:, 1].mean() / before - 1
    density = sim.densities.mean() / sim.fluid.rest_density - 1
    return [f"{volume:+.2%}", f"{density:+.2%}", f"{speeds(sim).max():.2f}"]


def dam_break(solver: pbf.SolverParams, seconds: float) -> list[str]:
    """A collapse: mean and largest compression."""
    tank = pbf.Box((0, 0, 0), (1.2, 0.8, 0.2))
    sim = pbf.Simulation(pbf.FluidParams(spacing=SPACING), solver, domain=tank)
    sim.add_particles(pbf.block((0, 0, 0), (0.4, 0.5, 0.2), SPACING))
    report = sim.advance(FRAME, frames=round(seconds / FRAME))
    return [f"{report.mean_density_error:.2%}", f"{report.max_density_error:.0%}"]


def droplet(solver: pbf.SolverParams, seconds: float) -> list[str]:
    """A ball at rest without gravity, which should stay one: its fastest particle, its radius."""
    fluid = pbf.FluidParams(spacing=SPACING, gravity=(0, 0, 0))
    sim = pbf.Simulation(fluid, solver)
    sim.add_particles(pbf.ball((0, 0, 0), 0.1, SPACING))
    before = radius(sim)
    sim.advance(FRAME, frames=round(seconds / FRAME))
    return [f"{speeds(sim).max():.3f}", f"{radius(sim) / before - 1:+.1%}"]


def speeds(sim: pbf.Simulation) -> np.ndarray:
    return np.linalg.norm(sim.velocities, axis=1)


def radius(sim: pbf.Simulation) -> float:
    return float(np.sqrt((sim.positions**2).sum(axis=1).mean()))


CASES: list[Callable[[pbf.SolverParams, float], list[str]]] = [resting, dam_break, droplet]


def main() -> None:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawTextHelpFormatter
    )
    parser.add_argument("--seconds", type=float, default=2.0, help="simulated time of each case")
    seconds = parser.parse_args().seconds
    print(
        "| | column: volume | mean density | fastest m/s | dam break: mean compression | largest "
        "| droplet: fastest m/s | radius | s |\n|---|---|---|---|---|---|---|---|---|"
    )
    for name, changes in VARIANTS.items():
        solver = pbf.SolverParams(substeps=16, iterations=2).replace(**changes)
        start = time.perf_counter()
        cells = [cell for case in CASES for cell in case(solver, seconds)]
        print(
            "|", " | ".join([name, *cells, f"{time.perf_counter() - start:.0f}"]), "|", flush=True
        )


if __name__ == "__main__":
    main()
