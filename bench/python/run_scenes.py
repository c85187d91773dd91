"""Time whole steps of scenes over thread counts; CSV on stdout, one row per run.

``python bench/python/run_scenes.py dam_break resting_tank --threads 1 2 --steps 100``

Rows of one scene must show one hash: the same work, bit for bit. The rules are in bench/README.md.
"""

from __future__ import annotations

import argparse
import csv
import os
import statistics
import subprocess
import sys
import time
from pathlib import Path

import pbfluids as pbf

COLUMNS = [
    "scene",
    "particles",
    "threads",
    "steps",
    "ms_min",
    "ms_median",
    "mean_density_error",
    "max_density_error",
    "hash",
    "commit",
]


def commit() -> str:
    """Short hash of the commit that is checked out, with a mark if files differ from it."""
    command = ["git", "describe", "--always", "--dirty"]
    here = Path(__file__).parent
    done = subprocess.run(command, cwd=here, capture_output=True, text=True, check=False)
    return done.stdout.strip() or "unknown"


def timed_run(name: str, threads: int, warm_up: int, steps: int) -> dict[str, object]:
    """Step a scene from its start; the times are of the steps after the warm-up."""
    scene = pbf.Scene.builtin(name, num_threads=threads)
    simulation = scene.simulation()
    dt = 1.0 / (scene.frame_rate * scene.solver.substeps)
    for _ in range(warm_up):
        simulation.step(dt)
    milliseconds, reports = [], []
    for _ in range(steps):
        start = time.perf_counter()
        reports.append(simulation.step(dt))
        milliseconds.append(1e3 * (time.perf_counter() - start))
    return {
        "scene": name,
        "particles": len(simulation),
        "threads": threads,
        "steps": steps,
        "ms_min": f"{min(milliseconds):.3f}",
        "ms_median": f"{statistics.median(milliseconds):.3f}",
        "mean_density_error": f"{statistics.fmean(r.mean_density_error for r in reports):.5f}",
        "max_density_error": f"{max(r.max_density_error for r in reports):.5f}",
        "hash": simulation.state_hash(),
    }


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("scenes", nargs="+", choices=pbf.Scene.names())
    parser.add_argument("--threads", nargs="+", type=int, default=[1, os.cpu_count() or 1])
    parser.add_argument("--warm-up", type=int, default=20)
    parser.add_argument("--steps", type=int, default=60)
    options = parser.parse_args()

    writer = csv.DictWriter(sys.stdout, COLUMNS)
    writer.writeheader()
    hashes: dict[str, set[object]] = {}
    for name in options.scenes:
        for threads in options.threads:
            row = timed_run(name, threads, options.warm_up, options.steps)
            hashes.setdefault(name, set()).add(row["hash"])
            writer.writerow(row | {"commit": commit()})
    different = [name for name, found in hashes.items() if len(found) > 1]
    if different:
        print(f"not the same bits for every thread count: {', '.join(different)}", file=sys.stderr)
    return 1 if different else 0


if __name__ == "__main__":
    sys.exit(main())
