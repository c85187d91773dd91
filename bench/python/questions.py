"""Measure what docs/questions.md answers; JSON and plots.

    pip install '.[validate]'
    python bench/python/questions.py --json out/questions.json --images docs/images/questions

``--again`` draws the plots from the JSON without measuring.
"""

from __future__ import annotations

import math
from itertools import product
from pathlib import Path
from typing import Any

import numpy as np
from machine import commit, processor
from numpy.typing import NDArray
from plots import legend_below, panels, results_of, save

import pbfluids as pbf
from pbfluids._core import stages

FRAME = 1 / 60
Array = NDArray[np.float32]
Table = dict[str, Any]

# --- the neighbor search and the iteration --------------------------------------------------------

SPACING = 0.02
TANK = pbf.Box((0, 0, 0), (1.2, 0.8, 0.2))
# Where centers of particles may be: their radius off the walls.
CENTERS = pbf.Box(
    tuple(low + SPACING / 2 for low in TANK.lower), tuple(up - SPACING / 2 for up in TANK.upper)
)
ITERATIONS = 4
SUBSTEPS = [1, 2, 4, 8, 16]


def dam_break(solver: pbf.SolverParams) -> pbf.Simulation:
    simulation = pbf.Simulation(pbf.FluidParams(spacing=SPACING), solver, domain=TANK)
    simulation.add_particles(pbf.block((0, 0, 0), (0.4, 0.5, 0.2), SPACING))
    return simulation


def compression(densities: Array) -> float:
    return float(np.mean(np.maximum(densities / 1000 - 1, 0)))


def step_with_rebuilds(
    x: Array, v: Array, fluid: pbf.FluidParams, solver: pbf.SolverParams, dt: float
) -> tuple[Array, Array]:
    """Take the plain method's step, its compiled stages in turn; each searches neighbors anew."""
    _, x_star = stages.predict(x, v, fluid, TANK, dt)
    for _ in range(ITERATIONS):
        _, multipliers = stages.multipliers(x_star, fluid, solver, TANK)
        dp = stages.corrections(x_star, multipliers, fluid, solver, TANK)
        x_star = stages.project(x_star + dp, CENTERS)
    return x_star, stages.xsph(x_star, (x_star - x) / dt, fluid, solver.xsph)


class Search:
    """A dam break with so many steps a frame; one step of each is also taken the other way."""

    def __init__(self, substeps: int) -> None:
        self.substeps = substeps
        self.solver = pbf.SolverParams(iterations=ITERATIONS, num_threads=1)
        self.simulation = dam_break(self.solver)
        self.found: dict[str, list[float]] = {}

    def note(self, **values: float) -> None:
        for key, value in values.items():
            self.found.setdefault(key, []).append(value)

    def advance(self) -> None:
        dt = FRAME / self.substeps
        for _ in range(self.substeps):
            before = self.simulation.positions, self.simulation.velocities
            report = self.simulation.step(dt)
            search = report.milliseconds["neighbors"] + report.milliseconds["boundary"]
            self.note(ms=report.total_milliseconds, search_ms=search)
        x, _ = step_with_rebuilds(*before, self.simulation.fluid, self.solver, dt)
        fresh, _ = stages.multipliers(x, self.simulation.fluid, self.solver, TANK)
        apart = np.linalg.norm(x - self.simulation.positions, axis=1) / SPACING
        self.note(
            once=compression(self.simulation.densities),
            seen=report.mean_density_error,
            rebuilt=compression(fresh),
            apart=float(np.mean(apart)),
        )

    def row(self) -> Table:
        """Means; times are medians by step, for the steps of a frame."""
        row = {key: float(np.mean(values)) for key, values in self.found.items()}
        for key in ("ms", "search_ms"):
            row[key] = self.substeps * float(np.median(self.found[key]))
        return {"substeps": self.substeps, **row}


def searches(frames: int = 36) -> list[Table]:
    """A frame of each in turns, so that what else the machine does meets all."""
    runs = [Search(substeps) for substeps in SUBSTEPS]
    for _ in range(frames):
        for run in runs:
            run.advance()
    return [run.row() for run in runs]


def draw_searches(results: Table, folder: Path) -> None:
    rows = results["searches"]
    substeps = [row["substeps"] for row in rows]
    figure, (left, right) = panels(2)
    for key, marker, label in [
        ("once", "o", "one search a step"),
        ("seen", "x", "one search, as its own list sees it"),
        ("rebuilt", "s", "one search an iteration"),
    ]:
        left.loglog(substeps, [row[key] for row in rows], marker + "-", label=label)
    left.set_xticks(substeps, [str(n) for n in substeps])
    left.minorticks_off()
    left.set(xlabel="time steps of a frame, 4 iterations each", ylabel="mean compression")
    left.legend(fontsize="small")
    ms = np.array([row["ms"] for row in rows])
    more = (ITERATIONS - 1) * np.array([row["search_ms"] for row in rows])
    right.loglog(ms, [row["once"] for row in rows], "o-", label="one search a step")
    right.loglog(ms + more, [row["rebuilt"] for row in rows], "s-", label="one search an iteration")
    for row in rows:
        right.annotate(
            f"{row['substeps']}", (row["ms"], row["once"]), (-9, -9), textcoords="offset points"
        )
    right.set(xlabel="time of a frame, one thread [ms]", ylabel="mean compression")
    right.set_title("by time; numbers: steps of a frame", fontsize="medium")
    right.legend(fontsize="small")
    save(figure, folder / "searches.png")


# --- vorticity confinement ------------------------------------------------------------------------

SIDE, SPEED = 1.0, 1.0  # Taylor-Green vortices: of the periodic square [m], fastest [m/s]
# The square has room for 3 % more particles: once they leave the lattice, which no flow keeps, a
# full one cannot have its rest density anywhere.
PLANE = pbf.FluidParams(spacing=0.985 * SPACING, dimensions=2, gravity=(0, 0, 0))
SQUARE = pbf.Box((0, 0, 0), (SIDE, SIDE, SPACING), periodic=(True, True, False))
STRENGTHS = [0.0, 0.01, 0.03, 0.1, 0.3]


def stirred() -> Array:
    """Positions that particles have come to after a shake."""
    random = np.random.default_rng(3)
    x = pbf.block(SQUARE.lower, SQUARE.upper, SPACING, dimensions=2)
    v = np.zeros_like(x)
    v[:, :2] = 0.3 * random.standard_normal((len(x), 2))
    solver = pbf.SolverParams(xsph=0.5, tolerance=1e-4, num_threads=1)
    simulation = pbf.Simulation(PLANE, solver, domain=SQUARE)
    simulation.add_particles(x, v)
    simulation.advance(FRAME, frames=60)
    return simulation.positions


def taylor_green(x: Array) -> Array:
    """Velocities of the four vortices."""
    k = 2 * math.pi / SIDE
    v = np.zeros_like(x)
    v[:, 0] = SPEED * np.sin(k * x[:, 0]) * np.cos(k * x[:, 1])
    v[:, 1] = -SPEED * np.cos(k * x[:, 0]) * np.sin(k * x[:, 1])
    return v


def padded(x: Array) -> tuple[Array, NDArray[np.int64]]:
    """Particles and their images within two support radii of the square, and whose they are."""
    margin = 4 * SPACING
    places, owners = [x], [np.arange(len(x))]
    for shift in product((-SIDE, 0, SIDE), repeat=2):
        if shift == (0, 0):
            continue
        moved = x + np.array([*shift, 0], np.float32)
        near = np.all((moved[:, :2] > -margin) & (moved[:, :2] < SIDE + margin), axis=1)
        places.append(moved[near])
        owners.append(np.flatnonzero(near))
    return np.concatenate(places), np.concatenate(owners)


def confinement(x: Array, v: Array) -> tuple[Array, Array]:
    """Vorticity along z [1/s], and N × ω [1/s], of periodic particles."""
    places, owners = padded(x)
    omega = stages.vorticity(places, v[owners], PLANE)
    omega = omega[: len(x)][owners]
    force = stages.confine(places, np.zeros_like(places), omega, PLANE, 1.0, 1.0)
    return omega[: len(x), 2], force[: len(x)]


def vortices(frames: int = 120) -> Table:
    table: Table = {}
    start = stirred()
    for strength in STRENGTHS:
        solver = pbf.SolverParams(vorticity=strength, num_threads=1)
        simulation = pbf.Simulation(PLANE, solver, domain=SQUARE)
        simulation.add_particles(start, taylor_green(start))
        rows = []
        for frame in range(frames + 1):
            if frame:
                simulation.advance(FRAME)
            if frame % 3 == 0:
                x, v = simulation.positions, simulation.velocities
                omega, force = confinement(x, v)
                lengths = np.linalg.norm(force, axis=1) * np.linalg.norm(v, axis=1)
                along = np.sum(force * v, axis=1)
                rows.append(
                    {
                        "time": simulation.time,
                        "energy": 0.5 * float(np.mean(np.sum(v**2, axis=1))),
                        "enstrophy": 0.5 * float(np.mean(omega**2)),
                        "along": float(np.sum(along) / np.sum(lengths)),
                    }
                )
        table[f"{strength:g}"] = {key: [row[key] for row in rows] for key in rows[0]}
    return table


def draw_vortices(results: Table, folder: Path) -> None:
    figure, axes = panels(3)
    for strength, rows in results["vortices"].items():
        label = f"vorticity = {strength} m/s"
        for axis, key in zip(axes, ("energy", "enstrophy", "along"), strict=True):
            axis.plot(rows["time"], rows[key], label=label)
            axis.set_xlabel("time [s]")
    axes[0].set_ylabel("kinetic energy [J/kg]")
    axes[1].set_ylabel("enstrophy, mean of ω²/2 [1/s²]")
    axes[2].set_ylabel("share of N × ω along the flow")
    axes[2].set_ylim(-1, 1)
    for axis in axes[:2]:
        axis.set_ylim(bottom=0)
    legend_below(figure, axes[0], 3)
    save(figure, folder / "vortices.png")

    x = pbf.block(SQUARE.lower, SQUARE.upper, SPACING, dimensions=2)
    v = taylor_green(x)
    omega, force = confinement(x, v)
    figure, (axis,) = panels(1, height=4.6)
    figure.set_figwidth(5.6)
    near = (x[:, 0] < SIDE / 2 + SPACING) & (x[:, 1] < SIDE / 2 + SPACING)
    colors = axis.tricontourf(*x[near, :2].T, omega[near], levels=12, cmap="Oranges", alpha=0.7)
    some = near & np.all((x[:, :2] / SPACING).astype(int) % 2 == 0, axis=1)
    for field, color in [(v, "k"), (force / 12, "C2")]:
        axis.quiver(*x[some, :2].T, *field[some, :2].T, color=color, width=0.007, scale=14)
    axis.set_title("black: v, up to 1 m/s; green: N × ω, up to 12 1/s", fontsize="small")
    axis.set(xlabel="x [m]", ylabel="y [m]", aspect="equal")
    figure.colorbar(colors, label="vorticity [1/s]", shrink=0.8)
    save(figure, folder / "direction.png")


# --- where the time goes --------------------------------------------------------------------------


def shares(steps: int = 120) -> Table:
    """Milliseconds of a step by stage, of the dam break under way."""
    solvers = {
        "plain": pbf.SolverParams(iterations=4, num_threads=1),
        "pressure": pbf.SolverParams(num_threads=1),
    }
    simulations = {name: dam_break(solver) for name, solver in solvers.items()}
    reports: dict[str, list[pbf.StepReport]] = {name: [] for name in solvers}
    for _ in range(steps):
        for name, simulation in simulations.items():
            reports[name].append(simulation.step(FRAME / 4))
    return {
        name: {
            "iterations": float(np.median([report.iterations for report in found[20:]])),
            "error": float(np.mean([report.mean_density_error for report in found[20:]])),
            "ms": {
                stage: float(np.median([report.milliseconds[stage] for report in found[20:]]))
                for stage in found[0].milliseconds
            },
        }
        for name, found in reports.items()
    }


def draw_shares(results: Table, folder: Path) -> None:
    rows = results["shares"]
    figure, (axis,) = panels(1, height=1.9)
    figure.set_figwidth(8)
    stages_shown = [
        stage
        for stage in next(iter(rows.values()))["ms"]
        if max(row["ms"][stage] for row in rows.values()) > 0
    ]
    left = np.zeros(len(rows))
    names = [f"{name}: {row['iterations']:.1f} iterations" for name, row in rows.items()]
    for stage in stages_shown:
        width = np.array([row["ms"][stage] for row in rows.values()])
        axis.barh(names, width, left=left, label=stage)
        left = left + width
    axis.invert_yaxis()
    axis.set_xlabel("time of a step, one thread [ms]")
    legend_below(figure, axis, 5)
    save(figure, folder / "shares.png")


def measure() -> Table:
    return {
        "commit": commit(),
        "processor": processor(),
        "shares": shares(),
        "searches": searches(),
        "vortices": vortices(),
    }


def main() -> None:
    results, images = results_of(__doc__, "questions", measure)
    for draw in (draw_searches, draw_vortices, draw_shares):
        draw(results, images)
    for row in results["searches"]:
        print({key: float(f"{value:.4g}") for key, value in row.items()})
    for name, row in results["shares"].items():
        print(name, f"{row['error']:.2%}", {k: round(v, 2) for k, v in row["ms"].items()})


if __name__ == "__main__":
    main()
