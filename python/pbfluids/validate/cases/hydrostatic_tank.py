"""A tank of water at rest: its height, its density, its pressure against ρ0 g (H − y)."""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt

from pbfluids import operators
from pbfluids.simulation import Box, FluidParams, Simulation, block
from pbfluids.validate.case import Result, Settings, history, kinetic_energy

FRAME = 1 / 60  # s
GRAVITY, DENSITY = 9.81, 1000.0  # m/s², kg/m³
REST_ENERGY = 1e-3  # J/kg: 4.5 cm/s

Vectors = npt.NDArray[np.float64]

DISCUSSION = """\
All parameters as they are by default, started on the rest lattice. Densities and pressures are
means over the last second. Height: twice the mean height of the particles. The mean density is that
of all particles deeper than *h*: above, there is no neighbor to count. First layers: centers within
one spacing of the floor or of a side wall, deeper than *h*. The line through the layers' means of
pressure is fitted once to *inner* particles, farther than *h* from every side wall and deeper than
*h* below the surface, and once to *all* of that depth.

Why pressures are not read off the multipliers. −ρ0 Λ/Δt² is 8 % too high at the floor: a particle
is held by sums over a few neighbors that stand for integrals, and on real arrangements they fall
short (the gradient of the *exact* field ρ0 g (H − y) at the same particles is what "gradient of the
exact pressure" below says); boundary particles carry no multiplier of their own, so beside a side
wall it takes more of one. The multipliers grow until their forces hold the weight all the same, so
the forces are right, and pressures are the mean virial of these, with a third of a particle's own
for a boundary particle's. What is left: particles at side walls hold no weight, since nothing tells
them how deep they are, so the middle carries a little more than its share, the more the narrower
the tank: in one only 0.1 m, ten spacings, from wall to wall the bottom is 2.2 % too high in the
middle, beyond the mark, and 1.2 % in all. And the lowest layer reads less, for part of what it
bears goes into the floor by collision response. Where layers are few, as in coarse tanks, the line
feels that."""


def run(settings: Settings) -> Result:
    """Simulate and measure."""
    depth, spacing = (0.4, 0.02) if settings.quick else (1.0, 0.01)
    width, thickness = (0.2, 0.16) if settings.quick else (0.2, 0.2)
    seconds = 2 if settings.quick else 5
    h = 2 * spacing
    settings.frames.expect(60 * seconds)
    simulation = Simulation(
        FluidParams(spacing=spacing, gravity=(0, -GRAVITY, 0)),
        settings.solver(),
        domain=Box((0, 0, 0), (width, 1.2 * depth, thickness)),
    )
    simulation.add_particles(block((0, 0, 0), (width, depth, thickness), spacing))
    name = f"d = {spacing} m"
    first = history(simulation, 60 * (seconds - 1), FRAME, settings, name, kinetic_energy)
    last = history(simulation, 60, FRAME, settings, name, sample)
    energies = first + [energy for energy, *_ in last[1:]]
    x, density, pressure = (np.concatenate(parts) for parts in list(zip(*last, strict=True))[1:])
    y = x[:, 1]
    from_side = np.minimum(x[:, [0, 2]], (width, thickness) - x[:, [0, 2]]).min(axis=1)
    height = 2 * float(y.mean())
    deep = y < height - h
    result = Result()
    result.check("height", 100 * (height / depth - 1), 1.0, "%")
    result.check("mean density, deeper than h", 100 * (density[deep].mean() - 1), 0.2, "%")
    floor, sides = deep & (y < spacing), deep & (from_side < spacing)
    result.check("first layer at the floor, density", 100 * (density[floor].mean() - 1), 2.0, "%")
    result.check("first layer at side walls, density", 100 * (density[sides].mean() - 1), 2.0, "%")

    bottom = DENSITY * GRAVITY * height
    inner = deep & (from_side > h)
    layers = {}
    for name, chosen in (("inner", inner), ("all", deep)):
        layers[name] = centers, means = layer_means(y[chosen], pressure[chosen], spacing)
        slope, at_floor = np.polyfit(centers, means, 1)
        unexplained = np.var(means - slope * centers - at_floor) / np.var(means)
        result.check(f"pressure, {name}: 1 − R² of layer means", unexplained, 0.01)
        error = 100 * (at_floor / bottom - 1)
        result.check(f"pressure, {name}: bottom against ρ0 g H", error, 2.0, "%")
    late = float(np.mean(energies[-60:]))
    result.check("kinetic energy in the last second", late, REST_ENERGY, "J/kg")
    result.check("kinetic energy, last second against largest", late / max(energies), 0.1)

    on_sides = sides & (y < height - 4 * h)
    like_inner = np.interp(y[on_sides], *layers["inner"])
    result.values["pressure at side walls, in inner ones"] = float(
        pressure[on_sides].sum() / like_inner.sum()
    )
    result.values["gradient of the exact pressure, inner, in ρ0 g"] = exact_gradient(
        simulation, inner[-len(simulation) :]
    )
    result.values["density of all particles, in ρ0"] = float(density.mean())
    result.series = {
        "t": [FRAME * k for k in range(len(energies))],
        "energy": energies,
        "height": height,
        "layers": {name: [c.tolist(), p.tolist()] for name, (c, p) in layers.items()},
        "walls": [v.tolist() for v in layer_means(y[sides], pressure[sides], spacing)],
    }
    return result


def sample(simulation: Simulation) -> tuple[float, Vectors, Vectors, Vectors]:
    """Kinetic energy, positions, densities in ρ0, pressures."""
    return (
        kinetic_energy(simulation),
        simulation.positions.astype(float),
        simulation.densities.astype(float) / DENSITY,
        simulation.pressures.astype(float),
    )


def layer_means(y: Vectors, values: Vectors, thickness: float) -> tuple[Vectors, Vectors]:
    """Means over layers: where they are and what they are."""
    layer = (y / thickness).astype(int)
    count = np.bincount(layer)
    filled = count > 0
    return (
        np.bincount(layer, y)[filled] / count[filled],
        np.bincount(layer, values)[filled] / count[filled],
    )


def exact_gradient(simulation: Simulation, inner: npt.NDArray[np.bool_]) -> float:
    """Mean of −∂p/∂y as the solver sums it, of p = −y, at the particles chosen."""
    x = simulation.positions
    found = operators.gradient(
        -x[:, 1],
        x,
        support_radius=2 * simulation.fluid.spacing,
        kernel="wendland",
        corrected=False,
    )
    return -float(found[inner, 1].mean())


def plot(result: dict[str, Any], figure: Any) -> None:
    """Draw pressure against depth, and energy over time."""
    series = result["series"]
    left, right = figure.subplots(1, 2)
    height = series["height"]
    bottom = DENSITY * GRAVITY * height
    left.plot([bottom / 1e3, 0], [0, height], "k-", lw=0.8, label="ρ0 g (H − y)")
    for name, (y, p) in (*series["layers"].items(), ("at side walls", series["walls"])):
        left.plot(np.divide(p, 1e3), y, ".", ms=3, label=name)
    left.set(xlabel="pressure [kPa]", ylabel="y [m]")
    left.legend()
    right.semilogy(series["t"], series["energy"])
    right.set(xlabel="t [s]", ylabel="mean kinetic energy [J/kg]")
