"""Race the ways to solve the density constraint; JSON and plots for docs/convergence.md.

    pip install '.[validate]'
    python bench/python/convergence.py --json out/convergence.json --images docs/images/convergence

``--again`` draws the plots from the JSON without measuring. Times are processor time of one thread,
which is wall time on an idle machine and hardly grows on a busy one; the runs take turns of a frame
so that whatever else the machine does meets all of them.
"""

from __future__ import annotations

import math
import time
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
from machine import commit, processor
from plots import legend_below, panels, results_of, save

import pbfluids as pbf
from pbfluids.errors import SimulationFailed

FRAME = 1 / 60
DT = FRAME / 4
G = 9.81
Table = dict[str, Any]


@dataclass(frozen=True)
class Case:
    """A block of fluid in a tank."""

    spacing: float
    fluid: tuple[float, float, float]
    tank: tuple[float, float, float]
    settle: int = 0  # frames before the representative step
    frames: int = 0  # of a whole run

    def simulation(self, solver: pbf.SolverParams, kernel: str | None = None) -> pbf.Simulation:
        fluid = pbf.FluidParams(spacing=self.spacing, kernel=kernel)
        tank = pbf.Box((0, 0, 0), self.tank)
        simulation = pbf.Simulation(fluid, solver.replace(num_threads=1), domain=tank)
        simulation.add_particles(pbf.block((0, 0, 0), self.fluid, self.spacing))
        return simulation


def column(slenderness: float, frames: int) -> Case:
    """As high as so many support radii, 8 spacings wide."""
    spacing = 0.01
    width, height = 8 * spacing, slenderness * 2 * spacing
    return Case(spacing, (width, height, width), (width, 1.5 * height, width), frames=frames)


CASES = {
    "tank, H/h = 12.5": column(12.5, frames=60),
    "column, H/h = 25": column(25, frames=40),
    "column, H/h = 50": column(50, frames=20),
    "column, H/h = 100": column(100, frames=6),
    "dam break": Case(0.015, (0.5, 0.5, 0.24), (1.5, 0.8, 0.24), settle=15, frames=60),
}


@dataclass(frozen=True)
class Way:
    """A combination: what the solver and the kernel are."""

    solver: pbf.SolverParams
    kernel: str | None = None


def pressure(**changes: Any) -> Way:
    kernel = changes.pop("kernel", None)
    return Way(pbf.SolverParams(method="pressure", **{"levels": 1, **changes}), kernel)


def plain(iterations: int, **changes: Any) -> Way:
    return Way(pbf.SolverParams(iterations=iterations), **changes)


# By the number of iterations, from one state.
ONE_STEP = {
    "plain, poly6 and spiky": plain(1),
    "plain, wendland": plain(1, kernel="wendland"),
    "pressure, cold, no nesterov": pressure(warm_start=0.0, acceleration="none"),
    "pressure, warm 0.5, no nesterov": pressure(warm_start=0.5, acceleration="none"),
    "pressure, cold": pressure(warm_start=0.0),
    "pressure, warm 0.25": pressure(warm_start=0.25),
    "pressure, warm 0.5": pressure(warm_start=0.5),
    "pressure, warm 0.25, two levels": pressure(warm_start=0.25, levels=2),
    "pressure, warm 0.5, cubic spline": pressure(warm_start=0.5, kernel="cubic_spline"),
    "pressure, warm 0.5, poly6 and spiky": pressure(warm_start=0.5, kernel="poly6_spiky"),
}
COUNTS = [1, 2, 4, 8, 16, 32, 64, 128]

RUNS = {
    "plain, 4 iterations": plain(4),
    "plain, 16 iterations": plain(16),
    "pressure, 4 iterations": pressure(iterations=4, warm_start=0.5),
    "pressure, cold, no nesterov": pressure(
        warm_start=0.0, acceleration="none", max_iterations=300
    ),
    "pressure, cold": pressure(warm_start=0.0, max_iterations=300),
    "pressure, warm 0.25": pressure(warm_start=0.25, max_iterations=300),
    "pressure, warm 0.5": pressure(warm_start=0.5, max_iterations=300),
    "pressure, warm 0.8": pressure(warm_start=0.8, max_iterations=300),
    "pressure, warm 0.25, two levels": pressure(warm_start=0.25, levels=2, max_iterations=300),
}

KERNELS = {
    "plain, 4 iterations, poly6 and spiky": plain(4),
    "plain, 4 iterations, wendland": plain(4, kernel="wendland"),
    "pressure, poly6 and spiky": pressure(kernel="poly6_spiky"),
    "pressure, cubic spline": pressure(kernel="cubic_spline"),
    "pressure, wendland": pressure(),
    "pressure, wendland, two levels (default)": pressure(levels=2),
}
SHARES = (0, 0.25, 0.5, 0.8, 0.95, 1)
WARMTH = {f"warm_start = {share:g}": pressure(warm_start=share) for share in SHARES}
SETTLING = Case(0.02, (0.16, 0.4, 0.16), (0.16, 0.6, 0.16), frames=240)

# Substeps of a frame, for the column of H/h = 12.5.
LENGTHS = [1, 2, 3, 4, 6]

SPLITS = [1, 2, 4, 8, 16]  # substeps of a frame, which has 16 iterations in all
SPLIT_METHODS = ["plain", "pressure"]


def kinetic_energy(simulation: pbf.Simulation) -> float:
    """J per kg of fluid."""
    return 0.5 * float(np.mean(np.sum(simulation.velocities.astype(float) ** 2, axis=1)))


def mean_height(simulation: pbf.Simulation) -> float:
    return float(simulation.positions[:, 1].mean())


def settled(case: Case, kernel: str | None) -> tuple[np.ndarray, np.ndarray]:
    """Positions and velocities in the middle of things; of a column, the rest lattice."""
    simulation = case.simulation(pbf.SolverParams(method="pressure"), kernel)
    if case.settle:
        simulation.advance(FRAME, frames=case.settle)
    return simulation.positions, simulation.velocities


def one_step(case: Case) -> Table:
    """Error after a step of so many iterations, and the weight that it left falling.

    All start from the same state, after a step with full iterations: the warm starts take over its
    pressures.
    """
    states: dict[str | None, tuple[np.ndarray, np.ndarray]] = {}

    def after(solver: pbf.SolverParams, kernel: str | None) -> tuple[float, float]:
        before = pbf.SolverParams(method="pressure", iterations=150, warm_start=0.0, num_threads=1)
        simulation = pbf.Simulation(
            pbf.FluidParams(spacing=case.spacing, kernel=kernel),
            before,
            domain=pbf.Box((0, 0, 0), case.tank),
        )
        simulation.add_particles(*states[kernel])
        simulation.step(DT)
        simulation.solver = solver.replace(num_threads=1)
        v = float(simulation.velocities[:, 1].mean())
        report = simulation.step(DT)
        return report.mean_density_error, float(simulation.velocities[:, 1].mean()) - v

    rows: Table = {}
    for name, way in ONE_STEP.items():
        kernel = case.simulation(way.solver, way.kernel).fluid.kernel
        if kernel not in states:
            states[kernel] = settled(case, kernel)
        errors, falling = [], []
        for count in COUNTS:
            error, gained = after(way.solver.replace(iterations=count), kernel)
            errors.append(error)
            falling.append(-gained / (G * DT))
        rows[name] = {"iterations": COUNTS, "error": errors, "falling": falling}
    return rows


@dataclass
class Trace:
    """A run, frame by frame, until it ends or explodes."""

    simulation: pbf.Simulation
    height: float  # [m]; the kinetic energy of a fall from there is more than there can be
    seconds: float = 0.0
    rows: list[Table] = field(default_factory=list)
    failed: str = ""

    def advance(self) -> None:
        if self.failed:
            return
        start = time.process_time()
        try:
            report = self.simulation.advance(FRAME)
        except SimulationFailed as error:
            self.failed = str(error)
            return
        self.seconds += time.process_time() - start
        energy = kinetic_energy(self.simulation)
        if energy > G * self.height:
            self.failed = f"kinetic energy of {energy:.3g} J/kg"
        self.rows.append(
            {
                "seconds": self.seconds,
                "time": self.simulation.time,
                "iterations": report.iterations / report.steps,
                "error": report.mean_density_error,
                "energy": energy,
                "height": mean_height(self.simulation),
            }
        )

    def table(self) -> Table:
        columns = {key: [row[key] for row in self.rows] for key in self.rows[0]}
        return columns | {"particles": len(self.simulation), "failed": self.failed}


def race(case: Case, ways: dict[str, Way]) -> Table:
    """Run all in turns of a frame; what explodes ends early."""
    traces = {
        name: Trace(case.simulation(way.solver, way.kernel), case.fluid[1])
        for name, way in ways.items()
    }
    for _ in range(case.frames):
        for trace in traces.values():
            trace.advance()
    return {name: trace.table() for name, trace in traces.items()}


def splits(case: Case) -> Table:
    """The same 16 iterations a frame in 1 to 16 substeps."""
    ways = {
        f"{method}, {substeps}": Way(
            pbf.SolverParams(method=method, substeps=substeps, iterations=16 // substeps)
        )
        for method in SPLIT_METHODS
        for substeps in SPLITS
    }
    return race(case, ways)


def wendland(q: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """W and its derivative by q, both times a constant that V takes back."""
    inside = np.maximum(1 - q, 0)
    return inside**4 * (1 + 4 * q), -20 * q * inside**3


def overshoot() -> Table:
    """Iterations of a periodic, slightly disturbed lattice in NumPy, with steps of several lengths.

    Positions move by Jacobi's iteration of the density constraint, lengths in spacings; the table
    has the root mean square of C after each, by ω times the largest eigenvalue.
    """
    n, h = 8, 2.0
    offsets = np.array([o for o in np.ndindex(5, 5, 5) if o != (2, 2, 2)]) - 2
    cells = np.array(list(np.ndindex(n, n, n)))
    neighbors = np.stack(
        [np.ravel_multi_index(((cells + o) % n).T, (n, n, n)) for o in offsets], axis=1
    )

    def terms(u: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        r = u[:, None] - u[neighbors] - offsets
        length = np.linalg.norm(r, axis=2)
        values, slope = wendland(length / h)
        return values, (slope / (h * length))[..., None] * r

    rest_values, rest_gradient = terms(np.zeros((n**3, 3)))
    volume = 1 / (1 + rest_values[0].sum())
    waves = np.stack(np.meshgrid(*3 * [np.arange(17) * math.pi / 16]), axis=-1).reshape(-1, 3)
    symbol = np.sum((np.sin(waves @ -offsets.T) @ rest_gradient[0]) ** 2, axis=1)
    largest = float(symbol.max() / np.sum(rest_gradient[0] ** 2))
    rows: Table = {"largest": largest}
    for share in (0.5, 1.0, 1.9, 2.1, largest):
        u = 0.01 * np.random.default_rng(1).standard_normal((n**3, 3))
        errors = []
        for _ in range(60):
            near, gradient = terms(u)
            gradient *= volume
            constraint = volume * (1 + near.sum(axis=1)) - 1
            errors.append(float(np.sqrt(np.mean(constraint**2))))
            denominator = np.sum(gradient**2, axis=(1, 2)) + np.sum(
                gradient.sum(axis=1) ** 2, axis=1
            )
            multipliers = -share / largest * constraint / denominator
            pairs = multipliers[:, None] + multipliers[neighbors]
            u = u + np.sum(pairs[..., None] * gradient, axis=1)
        rows[f"{share:.2g}"] = errors
    return rows


def growth(warm_start: float, solved: np.ndarray) -> np.ndarray:
    """Growth of a wave by time step, the largest root of docs/convergence.md's polynomial."""
    found = []
    for share in solved:
        k = share / (1 - share)
        # (1 - s/z) (1 - 1/z)^2 + k = 0, times z^3
        roots = np.roots([1 + k, -2 - warm_start, 1 + 2 * warm_start, -warm_start])
        found.append(float(np.abs(roots).max()))
    return np.array(found)


def lengths() -> Table:
    """Largest kinetic energy of a column at rest, by time step and warm start."""
    case = column(12.5, frames=30)
    rows: Table = {}
    for substeps in LENGTHS:
        ways = {
            f"{share:g}": pressure(warm_start=share, substeps=substeps, max_iterations=300)
            for share in SHARES
        }
        found = race(case, ways)
        number = math.sqrt(G * case.fluid[1]) * FRAME / substeps / case.spacing
        rows[f"{number:.2f}"] = {
            share: {"energy": max(row["energy"]), "failed": row["failed"]}
            for share, row in found.items()
        }
    return rows


def measure() -> Table:
    start = time.perf_counter()
    results: Table = {"commit": commit(), "processor": processor()}

    def part(name: str, table: Table) -> None:
        results[name] = table
        print(f"{time.perf_counter() - start:6.0f} s  {name}", flush=True)

    part("overshoot", overshoot())
    part("one_step", {name: one_step(case) for name, case in CASES.items()})
    part("kernels", race(SETTLING, KERNELS))
    part("warmth", race(SETTLING, WARMTH))
    part("lengths", lengths())
    part("splits", {name: splits(CASES[name]) for name in ("tank, H/h = 12.5", "dam break")})
    for name, case in CASES.items():
        part(f"run: {name}", race(case, RUNS))
    return results


def draw_one_step(results: Table, folder: Path) -> None:
    shown = [
        ("tank, H/h = 12.5", "error", "mean compression"),
        ("dam break", "error", "mean compression"),
        ("column, H/h = 50", "falling", "share of the weight not carried"),
    ]
    figure, axes = panels(len(shown))
    for axis, (case, key, label) in zip(axes, shown, strict=True):
        for way, row in results["one_step"][case].items():
            dashes = "--" if "plain" in way else ":" if "sp" in way else "-"
            axis.loglog(row["iterations"], np.abs(row[key]), dashes, marker=".", label=way, lw=1.3)
        axis.set(title=case, xlabel="iterations in the step", ylabel=label)
    legend_below(figure, axes[0], 3)
    save(figure, folder / "one_step.png")


def draw_runs(results: Table, folder: Path) -> None:
    shown = ["column, H/h = 50", "column, H/h = 100", "dam break"]
    figure, axes = panels(len(shown))
    for axis, case in zip(axes, shown, strict=True):
        for way, row in results[f"run: {case}"].items():
            line = axis.loglog(
                row["seconds"], row["error"], "--" if "plain" in way else "-", label=way, lw=1.3
            )
            if row["failed"]:
                axis.plot(row["seconds"][-1], row["error"][-1], "x", color=line[0].get_color())
        axis.set(title=case, xlabel="processor time [s]")
    axes[0].set_ylabel("mean compression")
    legend_below(figure, axes[0], 3)
    save(figure, folder / "runs.png")


def draw_settling(results: Table, folder: Path) -> None:
    figure, axes = panels(2)
    for axis, key in zip(axes, ("kernels", "warmth"), strict=True):
        for way, row in results[key].items():
            axis.semilogy(row["time"], row["energy"], "--" if "plain" in way else "-", label=way)
        axis.set(xlabel="time [s]", ylabel="kinetic energy [J/kg]")
        axis.legend(
            loc="upper center",
            bbox_to_anchor=(0.5, -0.17),
            ncols=2,
            frameon=False,
            fontsize="x-small",
        )  # beside the curves, which fill the panel
    axes[0].set_title("kernels")
    axes[1].set_title("warm starts, wendland")
    save(figure, folder / "settling.png")


def draw_splits(results: Table, folder: Path) -> None:
    cases = list(results["splits"])
    figure, axes = panels(len(cases) + 1)
    for method in SPLIT_METHODS:
        for axis, case in zip(axes, cases, strict=False):
            rows = results["splits"][case]
            errors = [np.mean(rows[f"{method}, {n}"]["error"]) for n in SPLITS]
            axis.loglog(SPLITS, errors, marker="o", label=method)
            axis.set(title=case, ylabel="mean compression over the run")
        rows = results["splits"][cases[0]]
        energies = [np.mean(rows[f"{method}, {n}"]["energy"][-20:]) for n in SPLITS]
        axes[-1].loglog(SPLITS, energies, marker="o", label=method)
    axes[-1].set(title=f"{cases[0]}, at rest", ylabel="kinetic energy [J/kg]")
    for axis in axes:
        axis.set_xlabel("substeps of a frame of 16 iterations")
        axis.set_xticks(SPLITS, [str(n) for n in SPLITS])
        axis.minorticks_off()
        axis.legend(fontsize="small")
    save(figure, folder / "splits.png")


def draw_theory(results: Table, folder: Path) -> None:
    figure, (left, right, map_) = panels(3)
    for share, errors in results["overshoot"].items():
        if share != "largest":
            left.semilogy(errors, label=f"ω = {share} / largest eigenvalue")
    left.set(
        title="step of the iterations, rest lattice",
        xlabel="iterations",
        ylabel="root mean square of C",
        ylim=(1e-6, 1),
    )
    left.legend(fontsize="x-small")
    solved = np.linspace(0.001, 0.6, 300)
    for share in SHARES:
        right.plot(solved, growth(share, solved), label=f"warm_start = {share:g}")
    right.axhline(1, color="k", lw=0.8)
    right.set(
        title="warm start",
        xlabel="share of a wave's error solved in a step",
        ylabel="growth of the wave in a step",
        ylim=(0.7, 1.25),
    )
    right.legend(fontsize="x-small")
    for number, row in results["lengths"].items():
        energies = [row[f"{share:g}"]["energy"] for share in SHARES]
        line = map_.semilogy(SHARES, energies, marker="o", label=f"√(gH) Δt/d = {number}")
        lost = [k for k, share in enumerate(SHARES) if row[f"{share:g}"]["failed"]]
        color = line[0].get_color()
        map_.plot([SHARES[k] for k in lost], [energies[k] for k in lost], "x", ms=12, color=color)
    map_.set(
        title="column at rest, H/h = 12.5",
        xlabel="warm_start",
        ylabel="largest kinetic energy [J/kg]",
    )
    map_.legend(fontsize="x-small")
    save(figure, folder / "stability.png")


def summary(results: Table) -> str:
    """The runs as a Markdown table: second half of each."""
    lines = [
        "| run | particles | iterations | ms a step | mean compression |",
        "|---|---|---|---|---|",
    ]
    for case in CASES:
        for way, row in results[f"run: {case}"].items():
            half = len(row["time"]) // 2
            if row["failed"]:
                cells = [f"refused after {row['time'][-1]:.2f} s", "", f"{row['error'][-1]:.2%}"]
            else:
                steps = 4 * (len(row["time"]) - half)
                ms = 1e3 * (row["seconds"][-1] - row["seconds"][half - 1]) / steps
                error = np.mean(row["error"][half:])
                cells = [f"{np.mean(row['iterations'][half:]):.0f}", f"{ms:.1f}", f"{error:.2%}"]
            lines.append(
                "| " + " | ".join([f"{case}: {way}", str(row["particles"]), *cells]) + " |"
            )
    return "\n".join(lines)


def main() -> None:
    results, images = results_of(__doc__, "convergence", measure)
    for draw in (draw_one_step, draw_runs, draw_settling, draw_splits, draw_theory):
        draw(results, images)
    print(summary(results))


if __name__ == "__main__":
    main()
