"""A disk that a strain flow draws out to an ellipse, against the equations of its axes [Mon94]."""

from __future__ import annotations

from typing import Any

import numpy as np

from pbfluids.simulation import FluidParams, Simulation, ball
from pbfluids.validate.case import Result, Settings, Vectors, history
from pbfluids.validate.ellipse import semi_axes, solution

RATE = 100.0  # of strain at the start [1/s]
END = 0.0076  # s

DISCUSSION = """\
A disk of 1 m, **v** = (−100 *x*, 100 *y*) 1/s, no gravity, no walls: an ideal fluid stays an
ellipse of constant area, *a*' = −*a A*, *A*' = *A*² (*a*⁴ − 1)/(*a*⁴ + 1), *b* = 1/*a*. The
semi-axes are those of the ellipse with the particles' second moments, 2 √⟨*x*²⟩ and 2 √⟨*y*²⟩, in
units of the disk's at the start; a particle at the tip would tell of itself only.

The coarser drop is too wide, and one at *d* = 0.04 m more so, by 19 %. By default the fluid
pushes and does not pull (`constraint_floor` 0), so nothing draws together what the strain has
loosened, and the drop swells: its median density says so. With a floor of −0.01, a pull that
answers one percent of thinning, it does not; and at half the spacing the default is within the
mark as well."""


def run(settings: Settings) -> Result:
    """Simulate and measure."""
    runs = [(0.05, None)] if settings.quick else [(0.02, None), (0.02, -0.01), (0.01, None)]
    count = 38
    settings.frames.expect(count * len(runs))
    t = np.linspace(0, END, count + 1)
    exact = solution(-RATE, 0.0, t)
    result = Result(series={"t": t.tolist(), "exact": exact.T.tolist(), "found": {}})
    for spacing, floor in runs:
        simulation = Simulation(
            FluidParams(spacing=spacing, dimensions=2, gravity=(0, 0, 0)),
            settings.solver(time_step="adaptive", min_time_step=1e-6, constraint_floor=floor),
        )
        x = ball((0, 0, 0), 1.0, spacing, dimensions=2)
        simulation.add_particles(x, x * np.array([-RATE, RATE, 0], np.float32))
        name = f"d = {spacing} m" + (f", floor {floor:g}" if floor else "")
        axes = np.array(history(simulation, count, END / count, settings, name, axes_of))
        found = axes / axes[0]
        for k, axis in enumerate("ab"):
            error = 100 * (found[-1, k] / exact[-1, k] - 1)
            result.check(f"semi-axis {axis}, {name}", error, 2.0, "%")
        result.values[f"median density at the end, {name}, in ρ0"] = float(
            np.median(simulation.densities) / simulation.fluid.rest_density
        )
        result.series["found"][name] = found.T.tolist()
        result.series["x"] = simulation.positions[:, :2].T.tolist()
    return result


def axes_of(simulation: Simulation) -> Vectors:
    """Semi-axes [m]."""
    return semi_axes(simulation.positions)


def plot(result: dict[str, Any], figure: Any) -> None:
    """Draw the axes over time, and the drop at the end."""
    series = result["series"]
    left, right = figure.subplots(1, 2, width_ratios=(2, 1))
    for k in range(2):
        left.plot(series["t"], series["exact"][k], "k-", lw=0.8, label=None if k else "exact")
        for index, (name, found) in enumerate(series["found"].items()):
            left.plot(
                series["t"], found[k], ".", color=f"C{index}", ms=3, label=None if k else name
            )
    left.set(xlabel="t [s]", ylabel="semi-axis / 1 m")
    left.legend()
    angle = np.linspace(0, 2 * np.pi, 200)
    a, b = series["exact"][0][-1], series["exact"][1][-1]
    right.plot(a * np.cos(angle), b * np.sin(angle), "k-", lw=1.5)
    right.plot(*series["x"], ".", ms=0.3)  # over the outline, which would hide some
    right.set(xlabel="x [m]", ylabel="y [m]", aspect="equal")
