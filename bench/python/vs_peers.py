"""The same dam break here and in other solvers; JSON into a file, Markdown on stdout.

    pip install . --group peers
    python bench/python/vs_peers.py --json out/peers.json --update-readme README.md

Each solver lives in a process of its own. They take turns, a few steps each, and wait at a pipe
otherwise, so that whatever else the machine does meets all of them. What is not installed is left
out. What is equal, what is not and how to read the tables: bench/README.md.
"""

from __future__ import annotations

import argparse
import json
import os
import statistics
import sys
import time
from dataclasses import asdict, dataclass, replace
from importlib.metadata import PackageNotFoundError, version
from multiprocessing.connection import Connection
from pathlib import Path
from typing import Any

import numpy as np
from child import Child
from machine import commit, processor
from numpy.typing import NDArray
from peers import OURS, SECOND, SYSTEMS, WORK, DamBreak

import pbfluids as pbf
from pbfluids._core import build_info

RULER = "poly6_spiky"  # the kernels of all who take the paper's steps
BEGIN, END = "<!-- peers:begin -->", "<!-- peers:end -->"


@dataclass(frozen=True)
class Plan:
    """How many steps are taken; those of the warm-up are not timed."""

    warm_up: int = 40
    blocks: int = 8
    steps: int = 5  # of each block
    turns: int = 20  # that make up the second


@dataclass(frozen=True)
class Block:
    """A few steps in a row."""

    milliseconds: list[float]  # of each whole step; of all together if seconds were asked for
    search_ms: float | None  # of the neighbor search in a step, mean
    positions: NDArray[np.float32]
    steps: int


def serve(name: str, case: DamBreak, pipe: Connection) -> None:
    """Build a solver, then do what the pipe asks for, until it asks for nothing.

    A whole number asks for that many steps, any other for that many seconds.
    """
    os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())  # solvers greet and log
    solver = SYSTEMS[name].make(case)
    pipe.send((solver.support_radius, solver.kernel))
    while asked := pipe.recv():
        if isinstance(asked, float):
            start = time.perf_counter()
            steps = solver.advance(asked)
            taken = 1e3 * (time.perf_counter() - start)
            pipe.send(Block([taken], None, solver.positions(), steps))
            continue
        steps = asked
        solver.step()  # not timed: the others have emptied the caches
        before = solver.search_ms
        milliseconds = []
        for _ in range(steps):
            start = time.perf_counter()
            solver.step()
            milliseconds.append(1e3 * (time.perf_counter() - start))
        after = solver.search_ms
        search = None if before is None or after is None else (after - before) / steps
        pipe.send(Block(milliseconds, search, solver.positions(), steps))


def compression(
    positions: NDArray[np.float32], case: DamBreak, kernel: str = RULER
) -> tuple[float, float]:
    """Measure max(ρ/ρ0 − 1, 0) away from the walls, mean and most; with one ruler if not told."""
    h = 2 * case.spacing
    density = pbf.operators.density(
        positions, support_radius=h, rest_density=1, kernel=kernel, num_threads=1
    )
    away = ((positions > h) & (positions < np.subtract(case.tank, h))).all(axis=1)
    above = np.maximum(density[away] - 1, 0)
    return float(above.mean()), float(above.max())


def tree_search(positions: NDArray[np.float32], radius: float) -> tuple[float, float]:
    """Let SciPy search; return the mean number of neighbors and the milliseconds it took.

    query_pairs gives every pair once and runs on one thread. It is still four times as fast as
    query_ball_point on two, which makes a Python list for each particle.
    """
    from scipy.spatial import cKDTree

    start = time.perf_counter()
    pairs = cKDTree(positions).query_pairs(radius, output_type="ndarray")
    milliseconds = 1e3 * (time.perf_counter() - start)
    return 2 * len(pairs) / len(positions), milliseconds


def children(work: str, case: DamBreak, skipped: dict[str, str]) -> list[Child]:
    """Start every solver that can do the work; those that do not start are added to skipped."""
    started = []
    for name, system in SYSTEMS.items():
        if work in system.work and name not in skipped:
            try:
                threads = dict.fromkeys(["OMP_NUM_THREADS", "QD_NUM_THREADS"], str(case.threads))
                task = replace(case, **WORK.get(work, {}))
                started.append(Child(serve, name, task, threads | system.environment))
            except EOFError:
                skipped[name] = f"did not start; it needs {system.needs}"
    return started


def measure(work: str, case: DamBreak, plan: Plan, skipped: dict[str, str]) -> list[dict[str, Any]]:
    """Let the solvers take turns; return a record of each."""
    solvers = children(work, case, skipped)
    keys = ("ms", "search_ms", "tree_ms", "density_error", "neighbors")
    records = [{"work": work, "system": s.name, **{key: [] for key in keys}} for s in solvers]
    for solver in solvers:
        solver.run(plan.warm_up)
    for _ in range(plan.blocks):
        for solver, record in zip(solvers, records, strict=True):
            block = solver.run(plan.steps)
            neighbors, tree_ms = tree_search(block.positions, solver.greeting[0])
            error, _ = compression(block.positions, case)
            values = (block.milliseconds, block.search_ms, tree_ms, error, neighbors)
            for key, value in zip(keys, values, strict=True):
                record[key].append(value)
    for solver in solvers:
        solver.close()
    return records


def measure_second(case: DamBreak, turns: int, skipped: dict[str, str]) -> list[dict[str, Any]]:
    """Let the solvers take turns until each has simulated a second; return a record of each."""
    solvers = children(SECOND, case, skipped)
    keys = ("ms", "steps", "mean_compression", "max_compression", "mean_by_ruler", "max_by_ruler")
    records = [{"system": s.name, "commit": commit(), **{key: [] for key in keys}} for s in solvers]
    for _ in range(turns):
        for solver, record in zip(solvers, records, strict=True):
            block = solver.run(1 / turns)
            own = compression(block.positions, case, solver.greeting[1])
            by_ruler = compression(block.positions, case)
            values = (block.milliseconds[0], block.steps, *own, *by_ruler)
            for key, value in zip(keys, values, strict=True):
                record[key].append(value)
    for solver in solvers:
        solver.close()
    return records


def installed() -> tuple[dict[str, str], dict[str, str]]:
    """Return the versions of the packages that are here; and solver → remedy for the others."""
    versions, skipped = {}, {}
    for name, system in SYSTEMS.items():
        try:
            versions[system.package] = version(system.package)
        except PackageNotFoundError:
            skipped[name] = f"not installed: pip install {system.package}"
    return versions, skipped


def result(case: DamBreak, plan: Plan) -> dict[str, Any]:
    """Measure everything."""
    versions, skipped = installed()
    load = os.getloadavg()[0]
    if load > 0.5:
        print(f"the machine is not idle (load {load:.1f}): expect noise", file=sys.stderr)
    runs = [record for work in WORK for record in measure(work, case, plan, skipped)]
    second = measure_second(case, plan.turns, skipped)
    for name, reason in skipped.items():
        print(f"without {name}: {reason}", file=sys.stderr)
    return {
        "commit": commit(),
        "build": build_info(),
        "processor": processor(),
        "load": load,
        "case": asdict(case),
        "plan": asdict(plan),
        "versions": versions,
        "skipped": skipped,
        "runs": runs,
        "second": second,
    }


def step_rows(runs: list[dict[str, Any]]) -> list[str]:
    """Write a row for each run; ratios are of blocks that followed one another."""
    ours = {run["work"]: run for run in runs if run["system"] == OURS}
    rows = []
    for run in runs:
        pairs = zip(run["ms"], ours[run["work"]]["ms"], strict=True)
        ratios = [statistics.median(a) / statistics.median(b) for a, b in pairs]
        times = f"{statistics.median(ratios):.2f} ({min(ratios):.2f} – {max(ratios):.2f})"
        cells = [
            run["work"],
            run["system"],
            f"{statistics.median(ms for block in run['ms'] for ms in block):.0f}",
            "1" if run["system"] == OURS else times,
            f"{statistics.fmean(run['density_error']):.1%}",
            f"{statistics.fmean(run['neighbors']):.0f}",
        ]
        rows.append("| " + " | ".join(cells) + " |")
    return rows


def search_rows(runs: list[dict[str, Any]], threads: int) -> list[str]:
    """Write a row for each neighbor search, which is the same whatever else a step does."""
    found: dict[str, list[float]] = {}
    for run in runs:
        if None not in run["search_ms"]:
            name = f"{SYSTEMS[run['system']].package}, {threads} threads"
            found.setdefault(name, []).extend(run["search_ms"])
    found["SciPy cKDTree, build and query_pairs, 1 thread"] = [
        ms for run in runs if run["system"] == OURS for ms in run["tree_ms"]
    ]
    return [f"| {name} | {statistics.median(ms):.0f} |" for name, ms in found.items()]


def second_rows(records: list[dict[str, Any]]) -> list[str]:
    """Write a row for each simulated second."""
    ours = sum(records[0]["ms"])
    return [
        f"| {r['system']} | {sum(r['ms']) / 1e3:.1f} | {sum(r['ms']) / ours:.1f} "
        f"| {sum(r['steps'])} | {statistics.fmean(r['mean_compression']):.2%} "
        f"| {statistics.fmean(r['max_compression']):.1%} "
        f"| {statistics.fmean(r['mean_by_ruler']):.2%}, {statistics.fmean(r['max_by_ruler']):.1%} |"
        for r in records
    ]


def tables(found: dict[str, Any]) -> str:
    """Write Markdown."""
    case, plan, versions = found["case"], found["plan"], found["versions"]
    count = f"{case['side'] ** 3:,}".replace(",", " ")
    others = "".join(f", {name} {number}" for name, number in versions.items() if name != OURS)
    return "\n".join(
        [
            f"Dam break of {count} particles, time step 1/{1 / case['time_step']:.0f} s, "
            f"{case['iterations']} iterations, {case['threads']} threads of {found['processor']}, "
            f"commit {found['commit']}{others}. Medians of {plan['blocks'] * plan['steps']} "
            f"steps after {plan['warm_up']}, in turns of {plan['steps']}.",
            "",
            "| a step | solver | ms | times ours (range) | density error | neighbors |",
            "|---|---|---:|---:|---:|---:|",
            *step_rows(found["runs"]),
            "",
            "| neighbor lists of them | ms |",
            "|---|---:|",
            *search_rows(found["runs"], case["threads"]),
            "",
            f"A simulated second, in turns of 1/{plan['turns']} s, commit "
            f"{found['second'][0]['commit']}, each solver with the time steps and the tolerance it "
            "comes with; compression by the kernel that it finds densities with, and both by "
            "poly6:",
            "",
            "| solver | s | times ours | steps | mean compression | worst particle | by poly6 |",
            "|---|---:|---:|---:|---:|---:|---:|",
            *second_rows(found["second"]),
        ]
    )


def update(page: Path, text: str, mark: str = BEGIN, end_mark: str = END) -> None:
    """Put the tables between the page's marks."""
    before = page.read_text(encoding="utf-8")
    head, begin, rest = before.partition(mark)
    _, end, tail = rest.partition(end_mark)
    if not (begin and end):
        raise SystemExit(f"{page} has no {mark} … {end_mark} to put the tables between")
    page.write_text(f"{head}{begin}\n{text}\n{end}{tail}", encoding="utf-8")


def main() -> None:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--side", type=int, default=DamBreak.side, help="particles along an edge")
    parser.add_argument("--threads", type=int, default=DamBreak.threads)
    parser.add_argument("--warm-up", type=int, default=Plan.warm_up, help="steps")
    parser.add_argument("--blocks", type=int, default=Plan.blocks, help="turns of each solver")
    parser.add_argument("--steps", type=int, default=Plan.steps, help="in a turn")
    parser.add_argument("--json", type=Path, default=Path("out/peers.json"))
    parser.add_argument("--again", action="store_true", help="do not measure, read the JSON")
    parser.add_argument("--update-readme", type=Path, metavar="FILE")
    options = parser.parse_args()

    if options.again:
        found = json.loads(options.json.read_text(encoding="utf-8"))
    else:
        case = DamBreak(side=options.side, threads=options.threads)
        found = result(case, Plan(options.warm_up, options.blocks, options.steps))
        options.json.parent.mkdir(parents=True, exist_ok=True)
        options.json.write_text(json.dumps(found, indent=1), encoding="utf-8")
    text = tables(found)
    print(text)
    if options.update_readme:
        update(options.update_readme, text)


if __name__ == "__main__":
    main()
