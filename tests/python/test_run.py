"""A run whose stages overlap: the same files, bounded memory, and the cores for one at a time."""

from __future__ import annotations

import json
import threading
import time

import numpy as np
import pytest

import pbfluids as pbf
from pbfluids import pipeline
from pbfluids import run as run_module
from pbfluids.errors import InvalidParameter
from pbfluids.run import draw, simulate
from pbfluids.run_directory import RunDirectory

COUNT = 6


@pytest.fixture
def scene(tiny):
    return pbf.Scene(tiny)


def in_turn(source, stages, finished):
    for item in source:
        result = item
        for stage in stages:
            result = stage(result)
        finished(result)


def contents(directory):
    """Every file by name; of the record all but the times that steps took."""
    files = {path.relative_to(directory): path.read_bytes() for path in directory.rglob("*.*")}
    for path in [path for path in files if path.name == "run.json"]:
        record = json.loads(files[path])
        for frame in record["frames"]:
            if frame["report"]:
                frame["report"].pop("milliseconds")
        files[path] = record
    return files


class FakeRenderer:
    """Draws the number of the picture; what it waits for is the test's."""

    software = True
    on_render = staticmethod(lambda _number: None)

    def __init__(self, width, height, **_light):
        self._shape, self._number = (height, width, 4), 0

    def render(self, *_, **_values):
        type(self).on_render(self._number)
        self._number += 1
        return np.full(self._shape, self._number, np.uint8)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        pass


@pytest.fixture
def fake(monkeypatch):
    class Own(FakeRenderer):
        pass

    monkeypatch.setattr(run_module, "Renderer", Own)
    return Own


@pytest.mark.gl
@pytest.mark.parametrize("render", [True, False])
def test_the_files_are_those_of_stages_in_turn(scene, tmp_path, monkeypatch, render):
    def run(name):
        video = tmp_path / name / "video.mp4" if render else None
        options = {"count": COUNT, "render": render, "size": (64, 48), "video_file": video}
        simulate(scene, tmp_path / name, **options)
        return contents(tmp_path / name)

    overlapped = run("overlapped")
    monkeypatch.setattr(pipeline, "run", in_turn)
    assert overlapped == run("in_turn")
    assert len(overlapped) == 1 + COUNT + (COUNT + 1 if render else 0)
    if render:
        monkeypatch.undo()
        draw(tmp_path / "overlapped", video_file=tmp_path / "overlapped/video.mp4")
        assert contents(tmp_path / "overlapped") == overlapped


def test_progress_comes_in_order_from_the_caller_s_thread(scene, tmp_path, fake):
    seen = []

    def progress(done, total, note):
        assert threading.current_thread() is threading.main_thread()
        seen.append((done, total, note.partition(",")[0]))

    simulate(scene, tmp_path, count=COUNT, size=(8, 8), progress=progress)
    assert seen == [(k + 1, COUNT, "64 particles") for k in range(COUNT)]
    seen.clear()
    draw(tmp_path, progress=progress)
    assert seen == [(k + 1, COUNT, "") for k in range(COUNT)]


def test_progress_of_drawing_again_counts_the_frames_that_are_there(scene, tmp_path, fake):
    simulate(scene, tmp_path, count=COUNT, size=(8, 8))
    (tmp_path / "particles/frame_00001.npz").unlink()
    seen = []
    draw(tmp_path, progress=lambda *step: seen.append(step))
    assert seen == [(k + 1, COUNT - 1, "") for k in range(COUNT - 1)]


@pytest.mark.parametrize("color_by", ["speed", "density", "pressure"])
def test_a_field_that_nobody_asked_for_is_not_computed(
    scene, tmp_path, fake, monkeypatch, color_by
):
    computed = []
    for name in ("densities", "pressures"):
        compute = getattr(pbf.Simulation, name).fget
        counted = property(
            lambda self, name=name, compute=compute: computed.append(name) or compute(self)
        )
        monkeypatch.setattr(pbf.Simulation, name, counted)
    simulate(scene.replace(color_by=color_by), tmp_path, count=COUNT, size=(8, 8))
    expected = {"speed": [], "density": ["densities"], "pressure": ["pressures"]}[color_by]
    assert computed == expected * COUNT


@pytest.fixture
def steps(monkeypatch):
    """Calls around each frame that is simulated."""
    advance = pbf.Simulation.advance
    hooks = {"before": lambda: None, "after": lambda: None}

    def hooked(self, seconds):
        hooks["before"]()
        report = advance(self, seconds)
        hooks["after"]()
        return report

    monkeypatch.setattr(pbf.Simulation, "advance", hooked)
    return hooks


def test_on_the_processor_simulating_and_drawing_take_turns(scene, tmp_path, fake, steps):
    cores, both = threading.Lock(), []

    def take(*_):
        both.append(not cores.acquire(blocking=False))
        time.sleep(0.005)
        if not both[-1]:
            cores.release()

    fake.on_render = staticmethod(take)
    steps["before"] = take
    simulate(scene, tmp_path, count=20, size=(8, 8))
    assert len(both) == 39
    assert not any(both)


def test_on_a_gpu_a_frame_is_simulated_while_the_one_before_is_drawn(scene, tmp_path, fake, steps):
    simulated = threading.Semaphore(0)

    def picture(number):
        if number < COUNT - 1:
            assert simulated.acquire(timeout=30)  # the next frame; in turn it would never come

    fake.software = False
    fake.on_render = staticmethod(picture)
    steps["after"] = simulated.release
    simulate(scene, tmp_path, count=COUNT, size=(8, 8))
    assert RunDirectory(tmp_path).frame_indices() == list(range(COUNT))


def test_a_slow_disk_holds_the_simulation_back(scene, tmp_path, fake, steps, monkeypatch):
    simulated, ahead = [0], []
    write = RunDirectory.write_image

    def slow(self, index, image):
        time.sleep(0.02)
        ahead.append(simulated[0] - index)
        return write(self, index, image)

    def count():
        simulated[0] += 1

    monkeypatch.setattr(RunDirectory, "write_image", slow)
    steps["after"] = count
    simulate(scene, tmp_path, count=25, size=(8, 8))
    assert max(ahead) <= 7  # three stages of two each, and one that waits in front of them


@pytest.mark.parametrize("failing", ["write_particles", "draw", "write_image"])
def test_an_error_in_a_stage_leaves_the_frames_before(scene, tmp_path, fake, monkeypatch, failing):
    def fail_late(number):
        if number == 3:
            raise OSError("no space left on device")

    if failing == "draw":
        fake.on_render = staticmethod(fail_late)
    else:
        method = getattr(RunDirectory, failing)

        def write(self, first, *rest):
            fail_late(getattr(first, "index", first))
            return method(self, first, *rest)

        monkeypatch.setattr(RunDirectory, failing, write)
    with pytest.raises(OSError, match="no space left"):
        simulate(scene, tmp_path, count=50, size=(8, 8))
    record = RunDirectory(tmp_path).read_record()
    assert record["status"] == "failed: no space left on device"
    assert [frame["index"] for frame in record["frames"]] == [0, 1, 2]
    for k in range(3):
        assert (tmp_path / f"images/frame_{k:05d}.png").exists()
        assert (tmp_path / f"particles/frame_{k:05d}.npz").exists()
    assert not (tmp_path / "images/frame_00003.png").exists()
    assert len(list(tmp_path.glob("particles/*"))) < 10


def test_an_earlier_run_is_removed_and_nothing_else(scene, tmp_path, fake):
    simulate(scene, tmp_path, count=4, size=(8, 8))
    foreign = [tmp_path / name for name in ("images/holiday.png", "particles/mine.npz")]
    left_by_a_killed_run = tmp_path / "images/.123.frame_00003.png"
    for file in (*foreign, left_by_a_killed_run):
        file.write_bytes(b"")
    simulate(scene, tmp_path, count=2, size=(8, 8))
    assert RunDirectory(tmp_path).frame_indices() == [0, 1]
    assert sorted(file.name for file in tmp_path.glob("images/*")) == [
        "frame_00000.png",
        "frame_00001.png",
        "holiday.png",
    ]
    assert all(file.exists() for file in foreign)


@pytest.mark.parametrize(
    ("change", "fault"),
    [
        ({"scene": "dam_break"}, "holds no scene"),
        ({"scene": None}, "holds no scene"),
        ({"size": [1, 2, 3]}, r"size = \[1, 2, 3\]: must be width and height"),
        ({"size": 5}, "size = 5: must be"),
        ({"size": [8.5, 8]}, r"size = \[8.5, 8\]: must be"),
    ],
)
def test_a_damaged_record_is_named(scene, tmp_path, fake, change, fault):
    run = simulate(scene, tmp_path, count=1, size=(8, 8))
    before = (tmp_path / "images/frame_00000.png").stat().st_mtime_ns
    run.write_record({**run.read_record(), **change})
    with pytest.raises(InvalidParameter, match=rf"run\.json: {fault}"):
        draw(tmp_path)
    assert (tmp_path / "images/frame_00000.png").stat().st_mtime_ns == before
