"""The same particles drawn here and by VTK's fluid mapper; JSON into a file, Markdown on stdout.

    pip install . --group vtk
    python bench/python/vs_vtk.py cloud.npy --spacing 0.02 --update-readme README.md

Both draw the clouds of the files given, and a dam break that is simulated first, at 60 thousand and
at a million particles. Each lives in a process of its own; they take turns, a few frames each, and
wait at a pipe otherwise. What is equal, what is not: bench/README.md.
"""

from __future__ import annotations

import argparse
import json
import os
import statistics
import sys
import time
from collections.abc import Callable
from dataclasses import asdict, dataclass
from multiprocessing.connection import Connection
from pathlib import Path
from typing import Any

import numpy as np
from child import Child
from machine import commit, processor
from numpy.typing import NDArray
from peers import DamBreak, PBFluids
from vs_peers import update

import pbfluids as pbf
from pbfluids import png

MARKS = ("<!-- vtk:begin -->", "<!-- vtk:end -->")
EYE, TARGET, FOV_Y = (2.9, 1.5, 2.7), (0.9, 0.35, 0.4), 45.0
SIZES = {"720p": (1280, 720), "1080p": (1920, 1080), "4K": (3840, 2160)}
#: Of a sprite, in particle distances: VTK leaves holes below 1.5, we do not.
SPRITE = {"VTK": 1.5, "pbfluids": 1.2}
#: VTK's kernel ends at 0.1 * filter radius * particle radius; 5 is its default filter radius.
VTK_KERNEL = 0.1 * 5

Draw = Callable[[NDArray[np.float32]], Any]
Frames = tuple[list[float], NDArray[np.uint8]]


@dataclass(frozen=True)
class Case:
    """A picture to draw."""

    cloud: str  # file with positions [m]
    spacing: float  # [m]
    size: str


def vtk_drawer(case: Case) -> tuple[Draw, Callable[[], NDArray[np.uint8]]]:
    """Make VTK's drawing of positions, and the reading of its picture."""
    import vtk
    from vtk.util.numpy_support import numpy_to_vtk, vtk_to_numpy

    radius = SPRITE["VTK"] * case.spacing
    mapper = vtk.vtkOpenGLFluidMapper()
    mapper.SetParticleRadius(radius)
    mapper.SetDisplayMode(mapper.TransparentFluidVolume)
    mapper.SetAttenuationColor(0.8, 0.2, 0.15)
    volume = vtk.vtkVolume()
    volume.SetMapper(mapper)
    renderer = vtk.vtkRenderer()
    renderer.SetBackground(0.66, 0.73, 0.79)
    renderer.AddVolume(volume)
    camera = renderer.GetActiveCamera()
    camera.SetPosition(*EYE)
    camera.SetFocalPoint(*TARGET)
    camera.SetViewUp(0, 1, 0)
    camera.SetViewAngle(FOV_Y)
    window = vtk.vtkRenderWindow()
    window.SetOffScreenRendering(1)
    window.SetMultiSamples(0)
    window.SetSize(*SIZES[case.size])
    window.AddRenderer(renderer)
    points, cloud = vtk.vtkPoints(), vtk.vtkPolyData()
    cloud.SetPoints(points)
    mapper.SetInputData(cloud)

    def draw(positions: NDArray[np.float32]) -> None:
        points.SetData(numpy_to_vtk(positions))
        points.Modified()
        cloud.Modified()
        renderer.ResetCameraClippingRange()
        window.Render()
        window.WaitForCompletion()

    def read() -> NDArray[np.uint8]:
        grab = vtk.vtkWindowToImageFilter()
        grab.SetInput(window)
        grab.ReadFrontBufferOff()
        grab.Update()
        width, height = SIZES[case.size]
        pixels = vtk_to_numpy(grab.GetOutput().GetPointData().GetScalars())
        return pixels.reshape(height, width, -1)[::-1, :, :3]

    return draw, read


def our_drawer(case: Case, *, as_it_comes: bool) -> tuple[Draw, Callable[[], NDArray[np.uint8]]]:
    """Make our drawing: with VTK's kernel, or as a scene file gives it."""
    d = case.spacing
    params = pbf.RenderParams(
        radius=SPRITE["pbfluids"] * d, drop_radius=0.62 * d, particle_volume=d**3, floor=as_it_comes
    )
    if not as_it_comes:
        kernel = VTK_KERNEL * SPRITE["VTK"] * d
        params = params.replace(
            smoothing_radius=kernel,
            smoothing_iterations=3,
            background="plain",
            background_color=(0.66, 0.73, 0.79),
        )
    camera = pbf.Camera(eye=EYE, target=TARGET, fov_y=FOV_Y)
    renderer = pbf.Renderer(*SIZES[case.size])
    last: list[NDArray[np.uint8]] = []

    def draw(positions: NDArray[np.float32]) -> None:
        last[:] = [renderer.render(positions, camera, params)]

    return draw, lambda: last[0]


DRAWERS: dict[str, Callable[[Case], tuple[Draw, Callable[[], NDArray[np.uint8]]]]] = {
    "pbfluids": lambda case: our_drawer(case, as_it_comes=True),
    "pbfluids, VTK's kernel": lambda case: our_drawer(case, as_it_comes=False),
    "VTK fluid mapper": vtk_drawer,
}
OURS, VTK = "pbfluids", "VTK fluid mapper"


def serve(name: str, case: Case, pipe: Connection) -> None:
    """Draw as many frames as the pipe asks for, until it asks for none."""
    os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
    positions = np.load(case.cloud).astype(np.float32)
    draw, read = DRAWERS[name](case)
    draw(positions)  # compiles and fills caches
    pipe.send(len(positions))
    while frames := pipe.recv():
        milliseconds = []
        for _ in range(frames):
            start = time.perf_counter()
            draw(positions)
            milliseconds.append(1e3 * (time.perf_counter() - start))
        pipe.send((milliseconds, read()))


def simulated(side: int, folder: Path) -> tuple[Path, float]:
    """Simulate a quarter of a second of the dam break, once; give the file and the spacing."""
    spacing = 0.78 / side
    case = DamBreak(side=side, spacing=spacing, time_step=spacing / 4.8, threads=0)
    path = folder / f"dam_break_{side**3}.npy"
    if not path.exists():
        solver = PBFluids(case)
        for _ in range(round(0.25 / case.time_step)):
            solver.step()
        folder.mkdir(parents=True, exist_ok=True)
        np.save(path, solver.positions())
    return path, case.spacing


def measure(case: Case, names: list[str], turns: int, frames: int, pictures: Path) -> list[Any]:
    """Let the drawers take turns; return a record of each and keep their pictures."""
    drawers, records = [], []
    for name in names:
        try:
            drawers.append(Child(serve, name, case))
        except EOFError:
            print(f"without {name}: it did not start", file=sys.stderr)
            continue
        records.append(
            asdict(case)
            | {
                "cloud": Path(case.cloud).name,
                "name": name,
                "particles": drawers[-1].greeting,
                "ms": [],
            }
        )
    for _ in range(turns):
        for drawer, record in zip(drawers, records, strict=True):
            # A frame of VTK's takes as long as dozens of ours.
            milliseconds, image = drawer.run(1 if drawer.name == VTK else frames)
            record["ms"].append(milliseconds)
            record["image"] = image
    for drawer, record in zip(drawers, records, strict=True):
        drawer.close()
        short = record["name"].replace(",", "").replace("'", "").replace(" ", "_")
        path = pictures / f"{Path(case.cloud).stem}_{case.size}_{short}.png"
        path.write_bytes(png.encode(np.ascontiguousarray(record.pop("image"))))
    return records


def rows(records: list[dict[str, Any]]) -> list[str]:
    """Write a row for each picture; ratios are of turns that followed one another."""
    ours = {(r["cloud"], r["size"]): r for r in records if r["name"] == OURS}
    found = []
    for r in records:
        pairs = zip(r["ms"], ours[r["cloud"], r["size"]]["ms"], strict=True)
        ratios = [statistics.median(a) / statistics.median(b) for a, b in pairs]
        times = f"{statistics.median(ratios):.1f} ({min(ratios):.1f} – {max(ratios):.1f})"
        cells = [
            Path(r["cloud"]).stem,
            f"{r['particles']:,}".replace(",", " "),
            r["size"],
            r["name"],
            f"{statistics.median(ms for turn in r['ms'] for ms in turn):.0f}",
            "1" if r["name"] == OURS else times,
        ]
        found.append("| " + " | ".join(cells) + " |")
    return found


def table(found: dict[str, Any]) -> str:
    """Write Markdown."""
    return "\n".join(
        [
            f"Whole frames by {found['driver']} and {os.cpu_count()} threads of "
            f"{found['processor']}, commit {found['commit']}, VTK {found['vtk']}. Medians of "
            f"{found['turns']} turns after a warm-up.",
            "",
            "| cloud | particles | picture | drawn by | ms | times ours (range) |",
            "|---|---:|---|---|---:|---:|",
            *rows(found["records"]),
        ]
    )


def vtk_version() -> str | None:
    """Return VTK's version, None if it is not installed."""
    try:
        from vtk import vtkVersion
    except ImportError:
        return None
    return str(vtkVersion.GetVTKVersion())


def main() -> None:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("clouds", nargs="*", type=Path, help="positions, shape (n, 3), .npy")
    parser.add_argument("--spacing", type=float, default=0.02, help="of their particles [m]")
    parser.add_argument("--sizes", nargs="+", choices=list(SIZES), default=list(SIZES))
    parser.add_argument("--turns", type=int, default=5)
    parser.add_argument("--frames", type=int, default=5, help="of ours in a turn")
    parser.add_argument("--most-for-vtk", type=int, default=200_000, help="particles")
    parser.add_argument("--json", type=Path, default=Path("out/vtk.json"))
    parser.add_argument("--again", action="store_true", help="do not measure, read the JSON")
    parser.add_argument("--update-readme", type=Path, metavar="FILE")
    options = parser.parse_args()

    if options.again:
        found = json.loads(options.json.read_text(encoding="utf-8"))
    else:
        if (load := os.getloadavg()[0]) > 0.5:
            print(f"the machine is not idle (load {load:.1f}): expect noise", file=sys.stderr)
        folder = options.json.parent
        clouds = [(path, options.spacing) for path in options.clouds]
        clouds += [simulated(side, folder) for side in (39, 100)]
        version = vtk_version()
        if version is None:
            print("without VTK: not installed: pip install vtk", file=sys.stderr)
        records = []
        for path, spacing in clouds:
            for size in options.sizes:
                few = len(np.load(path, mmap_mode="r")) <= options.most_for_vtk
                names = [name for name in DRAWERS if name != VTK or (few and version)]
                case = Case(str(path), spacing, size)
                records += measure(case, names, options.turns, options.frames, folder)
        with pbf.Renderer(16, 16) as renderer:
            driver = renderer.description
        found = {
            "commit": commit(),
            "processor": processor(),
            "driver": driver,
            "vtk": version,
            "turns": options.turns,
            "records": records,
        }
        options.json.parent.mkdir(parents=True, exist_ok=True)
        options.json.write_text(json.dumps(found, indent=1), encoding="utf-8")
    text = table(found)
    print(text)
    if options.update_readme:
        update(options.update_readme, text, *MARKS)


if __name__ == "__main__":
    main()
