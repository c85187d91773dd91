"""Two drops that collide in free space keep their momentum and angular momentum."""

from __future__ import annotations

from typing import Any

import numpy as np

from pbfluids.simulation import FluidParams, Simulation, SolverParams, ball
from pbfluids.validate.case import Result, Settings, Vectors

STEP = 1 / 240  # s
MARK = 1e-6

DISCUSSION = """\
Drops of 0.1 m at ±1 m/s, off center, without gravity and walls. Drift: the change of Σ **v** in a
step in units of Σ ‖**v**‖, and of Σ **x** × **v** in units of Σ ‖**x**‖ ‖**v**‖, the largest of all
steps. Corrections are antisymmetric, pair by pair, so momentum is kept to rounding.

Angular momentum is not, and no rounding is to blame. A pair's correction acts along the line that
joins it where the step *ends*. The new angular momentum, Σ **x**\\* × **v**, is Σ **x** × **v**,
since **v** = (**x**\\* − **x**)/Δ*t*: it counts as if corrections acted along the lines where the
step *began*. The two differ by the angle that a line turns in a step, so the drift per second falls
with Δ*t*: see the values for a step and for a half. XSPH does not act along
that line at all, and adds little."""


def two_drops(spacing: float, solver: SolverParams, kernel: str | None = None) -> Simulation:
    """Two drops that will hit one another off center."""
    simulation = Simulation(FluidParams(spacing=spacing, gravity=(0, 0, 0), kernel=kernel), solver)
    for side in (1, -1):
        x = ball((-0.11 * side, -0.03 * side, 0), 0.1, spacing)
        simulation.add_particles(x, np.tile([1.0 * side, 0, 0], (len(x), 1)))
    return simulation


def run(settings: Settings) -> Result:
    """Simulate and measure."""
    spacing, count = (0.02, 60) if settings.quick else (0.01, 120)
    runs = {
        "pressure": (settings.solver(), 1),
        "pressure, no XSPH": (settings.solver(xsph=0.0), 1),
        "pressure, half steps": (settings.solver(), 2),
        "plain": (settings.solver(iterations=4), 1),
    }
    settings.frames.expect(count * sum(parts for _, parts in runs.values()))
    result = Result(series={"seconds": count * STEP, "drift": {}})
    for name, (solver, parts) in runs.items():
        simulation = two_drops(spacing, solver)
        drifts = []
        before = start = momenta(simulation)
        for _ in range(count * parts):
            simulation.step(STEP / parts)
            after = momenta(simulation)
            drifts.append(np.linalg.norm(after[0] - before[0], axis=1) / after[1])
            before = after
            settings.frames.tick(name)
        linear, angular = np.array(drifts).T
        result.check(f"{name}: momentum per step", linear.max(), MARK)
        result.check(f"{name}: angular momentum per step", angular.max(), MARK)
        lost = np.linalg.norm(before[0][1] - start[0][1]) / np.linalg.norm(start[0][1])
        result.values[f"{name}: angular momentum, whole run, against that at the start"] = float(
            lost
        )
        result.series["drift"][name] = [linear.tolist(), angular.tolist()]
    return result


def momenta(simulation: Simulation) -> tuple[Vectors, Vectors]:
    """(Σ v, Σ x × v) and what they are measured in, (Σ ‖v‖, Σ ‖x‖ ‖v‖)."""
    x, v = simulation.positions.astype(float), simulation.velocities.astype(float)
    speed = np.linalg.norm(v, axis=1)
    return (
        np.array([v.sum(axis=0), np.cross(x, v).sum(axis=0)]),
        np.array([speed.sum(), (np.linalg.norm(x, axis=1) * speed).sum()]),
    )


def plot(result: dict[str, Any], figure: Any) -> None:
    """Draw the drifts over time."""
    series = result["series"]
    for k, axes in enumerate(figure.subplots(1, 2, sharey=True)):
        for name, drifts in series["drift"].items():
            t = np.linspace(0, series["seconds"], len(drifts[k]))
            axes.semilogy(t, np.maximum(drifts[k], 1e-12), lw=0.8, label=name)
        axes.axhline(MARK, color="k", lw=0.8, ls="--")
        axes.set(xlabel="t [s]", ylabel=("momentum", "angular momentum")[k] + " drift per step")
        axes.legend()
