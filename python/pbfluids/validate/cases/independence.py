"""What a settled column must not depend on: time step, tolerance, iterations, resolution."""

from __future__ import annotations

from typing import Any

import numpy as np

from pbfluids.simulation import Box, FluidParams, Simulation, block
from pbfluids.validate.case import Result, Settings, history

FRAME = 1 / 60  # s
GRAVITY, DENSITY = 9.81, 1000.0  # m/s², kg/m³
DEPTH, WIDTH = 0.5, 0.16  # m
SOFT = 5e-3  # s²/m²: 2.5 % at the bottom
MARK = 0.2  # %

DISCUSSION = """\
A column of 0.5 m, settled for 2 s. Its density is the mean of all particles deeper than two *h*,
its height twice their mean height, over the last half second, in percent of what is expected: ρ0
and 0.5 m, or with compliance *c* (5e-3 s²/m²) ρ0 exp(*c* g (H − y)), whose integral is the mass.

**With a tolerance** the solver takes as many iterations as time step, resolution and depth ask for,
and the density is that of the tolerance. **With counted iterations** it is the coarse level that
carries the weight of the column: a correction travels two support radii in an iteration, and with
`levels = 1` two, four and eight of them leave 4.5, 1.8 and 0.7 %."""


def run(settings: Settings) -> Result:
    """Simulate and measure."""
    spacing, fine = (0.04, 0.02) if settings.quick else (0.02, 0.01)
    runs: dict[str, tuple[float, dict[str, Any]]] = {}
    for compliance, words in ((0.0, "stiff"), (SOFT, "soft")):
        for tolerance in (1e-3, 3e-4):
            for substeps in (1, 2, 4):
                name = f"{words}, tolerance {tolerance:g}, dt 1/{60 * substeps} s"
                changes: dict[str, Any] = {
                    "substeps": substeps,
                    "tolerance": tolerance,
                    "compliance": compliance,
                }
                runs[name] = spacing, changes
    for count in (2, 4, 8):
        for compliance, words in ((0.0, "stiff"), (SOFT, "soft")):
            changes = {"method": "pressure", "iterations": count, "compliance": compliance}
            runs[f"{words}, {count} iterations"] = spacing, changes
    runs[f"stiff, d = {fine} m"] = fine, {}
    if settings.quick:
        runs = {name: runs[name] for name in list(runs)[:3]}
    frames = 60 if settings.quick else 120
    settings.frames.expect(frames * len(runs))
    result = Result(series={"density": {}, "height": {}})
    for name, (distance, changes) in runs.items():
        density, height = settled(distance, frames, settings, name, changes)
        result.check(f"{name}: density", density, MARK, "%")
        result.series["density"][name] = density
        result.series["height"][name] = height
        result.values[f"{name}: height %"] = height
    return result


def settled(
    spacing: float, frames: int, settings: Settings, name: str, changes: dict[str, Any]
) -> tuple[float, float]:
    """Density and height of a column against what is expected [%]."""
    solver = settings.solver(**changes)
    simulation = Simulation(
        FluidParams(spacing=spacing, gravity=(0, -GRAVITY, 0)),
        solver,
        domain=Box((0, 0, 0), (WIDTH, 1.2 * DEPTH, WIDTH)),
    )
    simulation.add_particles(block((0, 0, 0), (WIDTH, DEPTH, WIDTH), spacing))
    softness = solver.compliance * GRAVITY  # 1/m
    surface, middle = at_rest(softness)

    def measure(simulation: Simulation) -> tuple[float, float]:
        y, density = simulation.positions[:, 1].astype(float), simulation.densities / DENSITY
        deep = y < surface - 4 * spacing
        expected = np.exp(softness * (surface - y[deep]))
        return float(np.mean(density[deep] / expected)), float(y.mean())

    found = history(simulation, frames, FRAME, settings, name, measure)
    density, height = np.mean(found[-30:], axis=0)
    return 100 * (density - 1), 100 * (height / middle - 1)


def at_rest(softness: float) -> tuple[float, float]:
    """Surface and center of mass [m] where the density is ρ0 exp(softness (surface − y))."""
    if softness == 0:
        return DEPTH, DEPTH / 2
    above = DEPTH * (np.arange(1000) + 0.5) / 1000  # what lies above, as a height at rest density
    surface = np.log1p(softness * DEPTH) / softness
    return float(surface), float(surface - np.mean(np.log1p(softness * above)) / softness)


def plot(result: dict[str, Any], figure: Any) -> None:
    """Draw a bar for each run."""
    series = result["series"]
    names = list(series["density"])
    axes = figure.subplots()
    axes.barh(names, series["density"].values(), height=0.6, label="density")
    axes.plot(list(series["height"].values()), names, "k|", ms=8, label="height")
    axes.axvspan(-MARK, MARK, color="0.85", zorder=0)
    axes.set(xlabel="off what is expected [%]")
    axes.invert_yaxis()
    axes.legend()
