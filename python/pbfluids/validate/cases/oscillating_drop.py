"""A disk that swings between two ellipses in a central force, against its equations [MR13]."""

from __future__ import annotations

from typing import Any

import numpy as np

from pbfluids.simulation import FluidParams, Simulation, ball
from pbfluids.validate.case import Result, Settings, Vectors
from pbfluids.validate.ellipse import semi_axes, solution

RATE, FREQUENCY = 0.5, 1.0  # σ and Ω [1/s]
PERIOD = 4.567375  # s

DISCUSSION = """\
A disk of 1 m with **v** = (σ *x*, −σ *y*) and the acceleration −Ω² **x**, σ = 0.5 and Ω = 1 1/s; an
ideal fluid swings with a period of 4.567375 s and never tires. There are no forces of one's own in
the library, but without a warm start a simulation has no memory beside positions and velocities:
each step is that of a new simulation whose velocities have had Δ*t* times the acceleration added,
as the solver adds gravity's. The period is that of the difference of the semi-axes, from the first
to the last of its zeros that have the same sense; the amplitude, its largest value in the last
period against that of the first: what is lost is the method's own viscosity, see taylor_green."""


def run(settings: Settings) -> Result:
    """Simulate and measure."""
    spacing, periods = (0.1, 1.5) if settings.quick else (0.03, 3)
    step = 0.1 * spacing
    count = round(periods * PERIOD / step)
    settings.frames.expect(count)
    fluid = FluidParams(spacing=spacing, dimensions=2, gravity=(0, 0, 0))
    solver = settings.solver(warm_start=0.0)
    x = ball((0, 0, 0), 1.0, spacing, dimensions=2)
    v = x * np.array([RATE, -RATE, 0], np.float32)
    axes = [semi_axes(x)]
    for _ in range(count):
        simulation = Simulation(fluid, solver)
        simulation.add_particles(x, v - np.float32(step * FREQUENCY**2) * x)
        simulation.step(step)
        x, v = simulation.positions, simulation.velocities
        axes.append(semi_axes(x))
        settings.frames.tick(f"d = {spacing} m")
    found = np.array(axes) / axes[0]
    t = np.arange(count + 1, dtype=float) * step
    exact = solution(RATE, FREQUENCY, t)
    swing = found[:, 0] - found[:, 1]
    result = Result()
    result.check("period", 100 * (period(t, swing) / PERIOD - 1), 2.0, "%")
    last = np.abs(swing[t >= t[-1] - PERIOD]).max()
    first = np.abs(swing[t <= PERIOD]).max()
    result.check(
        "amplitude in the last turn against the first", 100 * (last / first - 1), 20.0, "%"
    )
    result.check("area at the end", 100 * (found[-1].prod() - 1), 2.0, "%")
    result.series = {"t": t.tolist(), "exact": exact.T.tolist(), "found": found.T.tolist()}
    return result


def period(t: Vectors, swing: Vectors) -> float:
    """Time between the zeros at which the swing begins to fall, the mean of all [s]."""
    before = np.flatnonzero((swing[:-1] > 0) & (swing[1:] <= 0))
    zeros = t[before] + (t[1] - t[0]) * swing[before] / (swing[before] - swing[before + 1])
    return float(np.diff(zeros).mean())


def plot(result: dict[str, Any], figure: Any) -> None:
    """Draw the semi-axes."""
    series = result["series"]
    axes = figure.subplots()
    for k, name in enumerate("ab"):
        axes.plot(series["t"], series["exact"][k], "k-", lw=0.8, label=None if k else "exact")
        axes.plot(series["t"], series["found"][k], lw=1.2, label=name)
    axes.set(xlabel="t [s]", ylabel="semi-axis / 1 m")
    figure.legend(loc="outside lower center", ncols=3)
