"""Simulate a scene into a directory, or draw such a directory again."""

from __future__ import annotations

import platform
import time
from collections.abc import Callable, Iterator, Mapping
from contextlib import ExitStack, contextmanager
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from pbfluids import _core, video
from pbfluids._version import __version__
from pbfluids.errors import InvalidParameter
from pbfluids.render import Renderer
from pbfluids.run_directory import RunDirectory
from pbfluids.scene import Frame, Scene

__all__ = ["draw", "simulate"]

# A run that is killed loses the reports of this long [s]; its frames are all there.
_RECORD_INTERVAL = 5.0

Progress = Callable[[int, int, str], None]  # frames done, frames in all, a word on the last
_Draw = Callable[[int, npt.NDArray[np.float32]], None]


def simulate(
    scene: Scene,
    directory: str | Path,
    *,
    count: int | None = None,
    render: bool = True,
    size: tuple[int, int] = (1280, 720),
    video_file: str | Path | None = None,
    progress: Progress | None = None,
) -> RunDirectory:
    """Simulate a scene and write particles and pictures of each frame.

    Parameters
    ----------
    scene
        What to simulate.
    directory
        Where to; an earlier run in it is removed.
    count
        Number of frames, the initial state among them; the scene's if not given.
    render
        Whether to draw.
    size
        Width and height of the pictures in pixels.
    video_file
        An MP4 file to write as well.
    progress
        Called after each frame with the number of frames done, of all, and a word on this one.

    Raises
    ------
    InvalidParameter
        If an argument breaks a rule.
    MissingExtra
        If the video needs a package that is not installed.
    RendererUnavailable
        If this machine cannot draw.
    SimulationFailed
        If a step cannot be completed. The frames before it are there.
    """
    if video_file is not None and not render:
        raise InvalidParameter(f"video = {video_file}: there are no pictures without rendering")
    run = RunDirectory(directory)
    total = scene.frame_count if count is None else count
    frames = scene.frames(total)
    with ExitStack() as stack:
        draw_frame = None
        if render:
            draw_frame = stack.enter_context(_pictures(run, scene, size, video_file))
        run.prepare(particles=True)
        record = _new_record(scene, size if render else None)
        try:
            _write_frames(run, record, frames, total, draw_frame, progress)
            record["status"] = "complete"
        except BaseException as error:
            interrupted = isinstance(error, KeyboardInterrupt)
            record["status"] = "interrupted" if interrupted else f"failed: {error}"
            raise
        finally:
            run.write_record(record)
    return run


def draw(
    directory: str | Path,
    *,
    overrides: Mapping[str, Any] | None = None,
    size: tuple[int, int] | None = None,
    video_file: str | Path | None = None,
    progress: Progress | None = None,
) -> RunDirectory:
    """Draw a finished run again, without simulating.

    Parameters
    ----------
    directory
        That of the run; its pictures are replaced.
    overrides
        Changes to the run's scene, as `Scene.replace` takes them; for example another camera.
    size
        Width and height of the pictures in pixels; those of the run if not given.
    video_file
        An MP4 file to write as well.
    progress
        Called after each frame with the number of frames done, of all, and a word on this one.

    Raises
    ------
    InvalidParameter
        If the directory holds no run, or an argument breaks a rule.
    MissingExtra
        If the video needs a package that is not installed.
    RendererUnavailable
        If this machine cannot draw.
    """
    run = RunDirectory(directory)
    record = run.read_record()
    scene = Scene(record["scene"], source=str(run.record_file))
    scene = scene.replace(**(overrides or {}))
    indices = run.frame_indices()
    if not indices:
        raise InvalidParameter(f"{run.path}: holds no frames of particles")
    width, height = size or record.get("size") or (1280, 720)
    with _pictures(run, scene, (width, height), video_file) as draw_frame:
        run.prepare(particles=False)
        for done, index in enumerate(indices, start=1):
            draw_frame(index, run.read_positions(index))
            if progress is not None:
                progress(done, len(indices), "")
    return run


@contextmanager
def _pictures(
    run: RunDirectory, scene: Scene, size: tuple[int, int], video_file: str | Path | None
) -> Iterator[_Draw]:
    """Give a function that draws a frame into the directory and the video."""
    width, height = size
    camera, params = scene.camera, scene.render_params
    with ExitStack() as stack:
        if video_file is not None:
            video.check(video_file, width, height)
        renderer = stack.enter_context(Renderer(width, height))
        movie = None
        if video_file is not None:
            Path(video_file).parent.mkdir(parents=True, exist_ok=True)
            movie = stack.enter_context(
                video.VideoWriter(video_file, width, height, scene.frame_rate)
            )

        def draw_frame(index: int, positions: npt.NDArray[np.float32]) -> None:
            image = renderer.render(positions, camera, params)
            run.write_image(index, image)
            if movie is not None:
                movie.write(image)

        yield draw_frame


def _write_frames(
    run: RunDirectory,
    record: dict[str, Any],
    frames: Iterator[Frame],
    total: int,
    draw_frame: _Draw | None,
    progress: Progress | None,
) -> None:
    last_record = -_RECORD_INTERVAL
    for frame in frames:
        run.write_particles(frame)
        if draw_frame is not None:
            draw_frame(frame.index, frame.positions)
        record["frames"].append(_frame_record(frame))
        if time.monotonic() - last_record >= _RECORD_INTERVAL:
            run.write_record(record)
            last_record = time.monotonic()
        if progress is not None:
            progress(frame.index + 1, total, _note(frame))


def _new_record(scene: Scene, size: tuple[int, int] | None) -> dict[str, Any]:
    build = _core.build_info()
    return {
        "format": 1,
        "status": "running",
        "versions": {
            "pbfluids": __version__,
            "python": platform.python_version(),
            "numpy": np.__version__,
            "compiler": build["compiler"],
            "eigen": build["eigen"],
        },
        "instruction_set": build["instruction_set"],
        "threads": _core.usable_threads(scene.solver.num_threads),
        "size": list(size) if size else None,
        "scene": scene.as_dict(),
        "frames": [],
    }


def _frame_record(frame: Frame) -> dict[str, Any]:
    report = frame.report
    return {
        "index": frame.index,
        "time": frame.time,
        "particles": len(frame.ids),
        "state_hash": frame.state_hash,
        "report": report
        and {
            "steps": report.steps,
            "iterations": report.iterations,
            "mean_density_error": report.mean_density_error,
            "max_density_error": report.max_density_error,
            "stable": report.stable,
            "milliseconds": report.milliseconds,
        },
    }


def _note(frame: Frame) -> str:
    particles = f"{len(frame.ids):,} particles"
    if frame.report is None:
        return particles
    return f"{particles}, density error {100 * frame.report.mean_density_error:.2f} %"
