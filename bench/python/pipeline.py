"""Time a run whose stages overlap against the same stages in turn; tables in Markdown on stdout.

``python bench/python/pipeline.py dam_break --frames 40 --repeats 5``

Both ways run the same code on the same scene, by turns, and must write the same files. The rules
are in bench/README.md, how to read the table in docs/performance.md. ``--gpu MS`` lets a picture
take that long without the processor, as on a GPU.
"""

from __future__ import annotations

import argparse
import hashlib
import os
import statistics
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Iterable, Sequence
from pathlib import Path
from typing import Any

from machine import commit, processor

import pbfluids as pbf
from pbfluids import pipeline
from pbfluids.run import simulate

# Counts, from outside, the threads of a process that run or want to.
WATCH = """
import os, sys, time
def wants(task):
    try:
        with open(f"/proc/{pid}/task/{task}/stat") as stat:
            return stat.read().rpartition(")")[2].split()[0] == "R"
    except OSError:
        return False
pid, counts = sys.argv[1], []
while os.getppid() == int(pid) and not select([sys.stdin], [], [], 0.003)[0]:
    counts.append(sum(map(wants, os.listdir(f"/proc/{pid}/task"))))
print(sum(counts) / max(len(counts), 1))
"""

overlapped = pipeline.run


class InTurn:
    """What `pipeline.run` does, a stage after the other; keeps the seconds that each takes."""

    def __init__(self) -> None:
        self.seconds: dict[str, float] = {}

    def __call__(
        self,
        source: Iterable[Any],
        stages: Sequence[Callable[[Any], Any]],
        finished: Callable[[Any], None],
    ) -> None:
        iterator = iter(source)
        while (item := self.timed("simulate", lambda: next(iterator, None))) is not None:
            for stage in stages:
                name = getattr(stage, "func", stage).__name__.strip("_")
                item = self.timed(name, lambda stage=stage, item=item: stage(item))
            self.timed("record", lambda item=item: finished(item))

    def timed(self, name: str, call: Callable[[], Any]) -> Any:
        start = time.perf_counter()
        result = call()
        self.seconds[name] = self.seconds.get(name, 0) + time.perf_counter() - start
        return result


class OnGpu:
    """A renderer that takes its time elsewhere."""

    software = False

    def __init__(self, seconds: float, width: int, height: int) -> None:
        camera = pbf.Camera(eye=(2.3, 1.35, 2.6), target=(0.95, 0.35, 0.25))
        with pbf.Renderer(width, height) as renderer:
            self._image = renderer.render(pbf.block((0, 0, 0), (1, 1, 0.5), spacing=0.1), camera)
        self._seconds = seconds

    def render(self, *_: object) -> Any:
        time.sleep(self._seconds)
        return self._image

    def __enter__(self) -> OnGpu:
        return self

    def __exit__(self, *_: object) -> None:
        pass


def files(directory: Path) -> str:
    """Hash what a run has written, all but its record, which holds times."""
    digest = hashlib.sha256()
    for path in sorted(directory.rglob("frame_*")) + sorted(directory.rglob("*.mp4")):
        digest.update(path.name.encode() + path.read_bytes())
    return digest.hexdigest()


def run_once(way: Callable[..., None], scene: pbf.Scene, options: Any) -> dict[str, Any]:
    pipeline.run = way  # type: ignore[assignment]
    with tempfile.TemporaryDirectory() as folder:
        video = Path(folder) / "video.mp4" if options.video else None
        watch = subprocess.Popen(
            [sys.executable, "-c", "from select import select" + WATCH, str(os.getpid())],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            text=True,
        )
        wall, cpu = time.perf_counter(), time.process_time()
        simulate(
            scene,
            folder,
            count=options.frames,
            render=not options.no_render,
            size=(options.width, options.height),
            video_file=video,
        )
        wall, cpu = time.perf_counter() - wall, time.process_time() - cpu
        threads = float(watch.communicate("\n")[0])
        return {"wall": wall, "cpu": cpu, "threads": threads, "files": files(Path(folder))}


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("scene", nargs="?", default="dam_break", choices=pbf.Scene.names())
    parser.add_argument("--frames", type=int, default=40)
    parser.add_argument("--repeats", type=int, default=5)
    parser.add_argument("--width", type=int, default=1280)
    parser.add_argument("--height", type=int, default=720)
    parser.add_argument("--no-render", action="store_true")
    parser.add_argument("--video", action="store_true")
    parser.add_argument("--gpu", type=float, metavar="MS", help="a picture takes this long")
    options = parser.parse_args()

    if options.gpu is not None:
        import pbfluids.run as module

        module.Renderer = lambda w, h: OnGpu(options.gpu / 1e3, w, h)  # type: ignore[attr-defined]
    scene = pbf.Scene.builtin(options.scene)
    turns, pairs = InTurn(), []
    run_once(overlapped, scene, options)  # warms up shader cache, codec and files
    for _ in range(options.repeats):
        pairs.append((run_once(turns, scene, options), run_once(overlapped, scene, options)))
    in_stages = sum(turns.seconds.values())
    turns.seconds["start and end"] = sum(before["wall"] for before, _ in pairs) - in_stages

    particles = len(scene.particles()[0])
    print(
        f"{options.scene}, {particles:,} particles, {options.frames} frames, "
        f"{options.width}x{options.height}, medians of {options.repeats}; {processor()}, "
        f"{len(os.sched_getaffinity(0))} cores, commit {commit()}\n"
    )
    frames = options.repeats * options.frames
    print("| stage alone | ms per frame |\n|---|---:|")
    for name, seconds in turns.seconds.items():
        print(f"| {name} | {1e3 * seconds / frames:.1f} |")
    print("\n| way | s | processor s | threads that run or want to |\n|---|---:|---:|---:|")
    for k, way in enumerate(["in turn", "overlapped"]):
        rows = [pair[k] for pair in pairs]
        middle = {
            key: statistics.median(row[key] for row in rows) for key in rows[0] if key != "files"
        }
        print(f"| {way} | {middle['wall']:.2f} | {middle['cpu']:.2f} | {middle['threads']:.2f} |")
    shares = sorted(after["wall"] / before["wall"] for before, after in pairs)
    slowest = max(turns.seconds.values()) / options.repeats
    ends = statistics.median(after["wall"] for _, after in pairs)
    print(
        f"\noverlapped / in turn: {statistics.median(shares):.3f} "
        f"({shares[0]:.3f} to {shares[-1]:.3f}); overlapped / slowest stage: {ends / slowest:.3f}"
    )
    different = len({row["files"] for pair in pairs for row in pair}) > 1
    if different:
        print("not the same files in every run", file=sys.stderr)
    return 1 if different else 0


if __name__ == "__main__":
    sys.exit(main())
