"""Time whole steps of scenes over threads and instruction sets; CSV on stdout, one row per run.

``python bench/python/run_scenes.py dam_break resting_tank --threads 1 2 --isa all --steps 100``

Rows of one scene must show one hash: the same work, bit for bit. The rules are in bench/README.md.
"""

from __future__ import annotations

import argparse
import csv
import itertools
import os
import statistics
import sys
import time

from machine import commit, processor

import pbfluids as pbf
from pbfluids._core import build_info, instruction_sets

COLUMNS = [
    "scene",
    "particles",
    "threads",
    "isa",
    "steps",
    "ms_min",
    "ms_median",
    "mean_density_error",
    "max_density_error",
    "hash",
    "commit",
    "processor",
]


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
        "isa": build_info()["instruction_set"],
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
    parser.add_argument("--isa", nargs="+", choices=[*instruction_sets(), "all"])
    parser.add_argument("--warm-up", type=int, default=20)
    parser.add_argument("--steps", type=int, default=60)
    options = parser.parse_args()

    writer = csv.DictWriter(sys.stdout, COLUMNS)
    writer.writeheader()
    hashes: dict[str, set[object]] = {}
    isas = options.isa or [build_info()["instruction_set"]]
    for name, threads, isa in itertools.product(
        options.scenes, options.threads, instruction_sets() if "all" in isas else isas
    ):
        os.environ["PBF_ISA"] = isa
        row = timed_run(name, threads, options.warm_up, options.steps)
        hashes.setdefault(name, set()).add(row["hash"])
        writer.writerow(row | {"commit": commit(), "processor": processor()})
    different = [name for name, found in hashes.items() if len(found) > 1]
    if different:
        print(f"not the same bits in every row: {', '.join(different)}", file=sys.stderr)
    return 1 if different else 0


if __name__ == "__main__":
    sys.exit(main())
