"""Simulate a scene into a directory, or draw such a directory again."""

from __future__ import annotations

import itertools
import platform
import threading
import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import AbstractContextManager, ExitStack, contextmanager, nullcontext
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from pbfluids import _core, pipeline, video
from pbfluids._version import __version__
from pbfluids.errors import InvalidParameter
from pbfluids.render import Renderer
from pbfluids.run_directory import RunDirectory
from pbfluids.scene import Frame, Scene
from pbfluids.scene_data import changed

__all__ = ["draw", "simulate"]

# A run that is killed loses the reports of this long [s]; its frames are all there.
_RECORD_INTERVAL = 5.0

Progress = Callable[[int, int, str], None]  # frames done, frames in all, a word on the last


@dataclass
class _Work:
    """A frame on its way through the stages."""

    index: int
    positions: npt.NDArray[np.float32]
    values: npt.NDArray[np.float32] | None  # what colors the particles
    frame: Frame | None = None
    image: Any = None


_Stage = Callable[[_Work], _Work]
_Cores = AbstractContextManager[Any]


def simulate(
    scene: Scene,
    directory: str | Path,
    *,
    count: int | None = None,
    render: bool = True,
    size: tuple[int, int] = (1280, 720),
    video_file: str | Path | None = None,
    fields: Sequence[str] = (),
    progress: Progress | None = None,
) -> RunDirectory:
    """Simulate a scene and write particles and pictures of each frame.

    A frame is simulated while the one before it is drawn and those before that are written; the
    files are the same as if that happened in turn.

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
    fields
        What the files of particles hold beside positions, velocities and ids, as
        `Scene.frames` takes it.
    progress
        Called after each frame with the number of frames done, of all, and a word on this one.

    Raises
    ------
    InvalidParameter
        If an argument breaks a rule.
    MissingExtra
        If the video, a mesh or the environment map needs a package that is not installed.
    RendererUnavailable
        If PBF_EGL_DEVICE asks for a device that is not there.
    SimulationFailed
        If a step cannot be completed. The frames before it are there.
    """
    if video_file is not None and not render:
        raise InvalidParameter(f"video = {video_file}: there are no pictures without rendering")
    run = RunDirectory(directory)
    total = scene.frame_count if count is None else count
    frames = scene.frames(total, fields=fields)
    with ExitStack() as stack:
        stages: list[_Stage] = [partial(_write_particles, run)]
        cores: _Cores = nullcontext()
        if render:
            drawing, cores = stack.enter_context(_pictures(run, scene, size, video_file))
            stages += drawing
        run.prepare(particles=True)
        record = _new_record(scene, size if render else None)
        try:
            pipeline.run(
                _in_turn(scene, frames, cores), stages, _Notes(run, record, total, progress)
            )
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
        If the video, a mesh or the environment map needs a package that is not installed.
    RendererUnavailable
        If PBF_EGL_DEVICE asks for a device that is not there.
    """
    run = RunDirectory(directory)
    record = run.read_record()
    scene = Scene(changed(record["scene"], overrides or {}), source=str(run.record_file))
    indices = run.frame_indices()
    total = len(indices)
    if not total:
        raise InvalidParameter(f"{run.path}: holds no frames of particles")
    width, height = size or record.get("size") or (1280, 720)
    with _pictures(run, scene, (width, height), video_file) as (stages, _):
        run.prepare(particles=False)

        done = itertools.count(1)

        def finished(_: _Work) -> None:
            if progress is not None:
                progress(next(done), total, "")

        def read(index: int) -> _Work:
            particles = run.read_particles(index)
            return _Work(index, particles["positions"], scene.values(particles))

        pipeline.run(map(read, indices), stages, finished)
    return run


@contextmanager
def _pictures(
    run: RunDirectory, scene: Scene, size: tuple[int, int], video_file: str | Path | None
) -> Iterator[tuple[list[_Stage], _Cores]]:
    """Give the stages that draw into the directory and the video, and what simulating waits for.

    Drawn on the processor, a picture takes all cores, as a time step does: they take turns. What
    compresses and writes takes one core each, and fills the gaps that the others leave.
    """
    width, height = size
    camera, params, meshes = scene.camera, scene.render_params, scene.meshes()
    light = scene.environment_map()
    with ExitStack() as stack:
        if video_file is not None:
            video.check(video_file, width, height)
        renderer = stack.enter_context(Renderer(width, height, environment_map=light))
        cores: _Cores = threading.Lock() if renderer.software else nullcontext()

        def draw_frame(work: _Work) -> _Work:
            with cores:
                work.image = renderer.render(
                    work.positions, camera, params, meshes=meshes, values=work.values
                )
            return work

        def write_image(work: _Work) -> _Work:
            run.write_image(work.index, work.image)
            return work

        stages: list[_Stage] = [draw_frame, write_image]
        if video_file is not None:
            Path(video_file).parent.mkdir(parents=True, exist_ok=True)
            movie = stack.enter_context(
                video.VideoWriter(video_file, width, height, scene.frame_rate)
            )

            def write_movie(work: _Work) -> _Work:
                movie.write(work.image)
                return work

            stages.append(write_movie)
        yield stages, cores


def _in_turn(scene: Scene, frames: Iterator[Frame], cores: _Cores) -> Iterator[_Work]:
    """Give the frames; simulating them waits for the cores."""
    while True:
        with cores:
            frame = next(frames, None)
        if frame is None:
            return
        yield _Work(frame.index, frame.positions, scene.values(frame), frame)


def _write_particles(run: RunDirectory, work: _Work) -> _Work:
    assert work.frame is not None
    run.write_particles(work.frame)
    return work


class _Notes:
    """Notes each frame that is written, and tells whoever wants to know."""

    def __init__(
        self, run: RunDirectory, record: dict[str, Any], total: int, progress: Progress | None
    ) -> None:
        self._run, self._record = run, record
        self._total, self._progress = total, progress
        self._written = -_RECORD_INTERVAL

    def __call__(self, work: _Work) -> None:
        frame = work.frame
        assert frame is not None
        self._record["frames"].append(_frame_record(frame))
        if time.monotonic() - self._written >= _RECORD_INTERVAL:
            self._run.write_record(self._record)
            self._written = time.monotonic()
        if self._progress is not None:
            self._progress(frame.index + 1, self._total, _note(frame))


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
