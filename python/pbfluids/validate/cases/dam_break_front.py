"""The front of a collapsing column against the measurements of Martin and Moyce [MM52]."""

from __future__ import annotations

from typing import Any

import numpy as np

from pbfluids.simulation import Box, FluidParams, Simulation, block
from pbfluids.validate.case import Result, Settings, history, rms

WIDTH = 0.05715  # a of the column [m], which is 2 a high
GRAVITY = 9.81  # m/s²
# Table 2, n² = 2: T = t √(2 g/a) and Z = x/a.
T = (0.84, 1.19, 1.43, 1.63, 1.83, 1.98, 2.20, 2.32, 2.51, 2.65, 2.83, 2.98, 3.11, 3.33)
Z = (1.22, 1.44, 1.67, 1.89, 2.11, 2.33, 2.56, 2.78, 3.00, 3.22, 3.44, 3.67, 3.89, 4.11)
GATE = 0.175  # T at which the water of the experiment comes free, as often assumed

DISCUSSION = """\
In 2-D, walls without friction, time steps by the CFL rule (0.4), everything else as it is by
default. The front is that of the body of water: along the particles whose centers are within one
and a half spacings of the floor, from the wall on, it is where the first gap wider than the support
radius begins, plus half a spacing. A percentile would depend on how much water lies on the floor,
and the fastest particle is a drop ahead of the front. Two sets of measurements of this experiment
are 6 to 9 % apart, hence the mark of 10 %; the aim is 5 %. The gate that held the water takes time
to go: with the shift, our water is let go at *T* = 0.175 of the experiment's clock.

As it is, the front is ahead of the experiment from the first points on, by about 0.3 in *Z* at all
later times, hence the misses: the water of the simulation is free at once. The shift leaves a third
of the difference or less. The finer fluid is ahead of the coarser; whether friction at the floor is
what holds back the real one was not tried."""


def reach(simulation: Simulation) -> tuple[float, float]:
    """How far fluid on the floor reaches without a gap, and how far the fastest particle [m]."""
    x, spacing = simulation.positions.astype(float), simulation.fluid.spacing
    on_floor = np.sort(x[x[:, 1] < 1.5 * spacing, 0])
    gaps = np.flatnonzero(np.diff(on_floor) > 2 * spacing)
    front = on_floor[gaps[0] if len(gaps) else -1]
    return float(front) + spacing / 2, float(x[:, 0].max()) + spacing / 2


def run(settings: Settings) -> Result:
    """Simulate and measure."""
    resolutions = (10, 20) if settings.quick else (20, 40)
    unit = np.sqrt(WIDTH / (2 * GRAVITY))  # seconds in a T of 1
    interval, count = 0.05, 70
    settings.frames.expect(count * len(resolutions))
    times = (interval * np.arange(count + 1)).tolist()
    result = Result(series={"T_measured": T, "Z_measured": Z, "T": times, "Z": {}, "fastest": {}})
    for resolution in resolutions:
        spacing = WIDTH / resolution
        simulation = Simulation(
            FluidParams(spacing=spacing, dimensions=2, gravity=(0, -GRAVITY, 0)),
            settings.solver(time_step="adaptive", min_time_step=1e-5),
            domain=Box((0, 0, 0), (6 * WIDTH, 4 * WIDTH, WIDTH)),
        )
        simulation.add_particles(block((0, 0, 0), (WIDTH, 2 * WIDTH, 0), spacing, dimensions=2))
        name = f"a/d = {resolution}"
        found = np.array(history(simulation, count, interval * unit, settings, name, reach))
        fronts, fastest = (found.T / WIDTH).tolist()
        result.series["Z"][name] = fronts
        result.series["fastest"][name] = fastest
        for shift, words in ((0.0, "as it is"), (GATE, "gate shift")):
            at = np.interp(np.array(T) - shift, times, fronts)
            error = 100 * rms(at / Z - 1)
            result.check(f"RMS error of Z, {name}, {words}", error, 10.0, "%")
    return result


def plot(result: dict[str, Any], figure: Any) -> None:
    """Draw the fronts."""
    series = result["series"]
    axes = figure.subplots()
    for index, (name, fronts) in enumerate(series["Z"].items()):
        axes.plot(series["T"], fronts, color=f"C{index}", label=name)
    for index, fastest in enumerate(series["fastest"].values()):  # on the fronts, which hide them
        label = None if index else "fastest particle"
        axes.plot(series["T"], fastest, "k:", lw=1.0, label=label)
    axes.plot(series["T_measured"], series["Z_measured"], "ko", ms=4, label="Martin & Moyce")
    axes.set(xlabel="T = t √(2g/a)", ylabel="Z = x/a")
    axes.legend()
