"""The command line: what it writes, what it says, how it ends."""

from __future__ import annotations

import json
import os
import pty
import signal
import subprocess
import sys
import time

import av
import numpy as np
import pytest
from PIL import Image

import pbfluids as pbf
from pbfluids.cli import main
from pbfluids.run_directory import RunDirectory

SIZE = ["--size", "64x48"]


@pytest.fixture
def run(capsys):
    """Run the command in this process: exit code, stdout, stderr."""

    def call(*arguments):
        code = main([str(argument) for argument in arguments])
        out, err = capsys.readouterr()
        return code, out, err

    return call


def record_of(directory):
    return json.loads((directory / "run.json").read_text(encoding="utf-8"))


def files_in(directory):
    return sorted(str(path.relative_to(directory)) for path in directory.rglob("*.*"))


def test_a_run_without_rendering_writes_particles_and_a_record(run, tiny_file, tmp_path):
    out = tmp_path / "out"
    code, stdout, stderr = run("run", tiny_file, "--out", out, "--no-render")
    assert code == 0
    assert files_in(out) == [
        *(f"particles/frame_0000{k}.npz" for k in range(3)),
        "run.json",
    ]
    assert f"{out}/run.json" in stdout
    assert "tiny: frame 3/3, 64 particles, density error" in stderr
    record = record_of(out)
    assert record["status"] == "complete"
    assert record["versions"]["pbfluids"] == pbf.__version__
    assert record["instruction_set"]
    assert record["threads"] >= 1
    assert [frame["index"] for frame in record["frames"]] == [0, 1, 2]
    assert record["frames"][0]["report"] is None
    assert record["frames"][2]["report"]["iterations"] == 2
    assert pbf.Scene(record["scene"]) == pbf.Scene.load(tiny_file)


def test_the_particles_are_those_of_the_scene_s_frames(run, tiny_file, tmp_path):
    run("run", tiny_file, "--out", tmp_path / "out", "--no-render")
    record = record_of(tmp_path / "out")
    for frame in pbf.Scene.load(tiny_file).frames():
        with np.load(tmp_path / f"out/particles/frame_{frame.index:05d}.npz") as arrays:
            assert sorted(arrays) == ["ids", "positions", "time", "velocities"]
            np.testing.assert_array_equal(arrays["positions"], frame.positions)
            np.testing.assert_array_equal(arrays["velocities"], frame.velocities)
            np.testing.assert_array_equal(arrays["ids"], frame.ids)
            assert arrays["time"] == frame.time
        assert record["frames"][frame.index]["state_hash"] == frame.state_hash


@pytest.mark.gl
def test_a_run_writes_pictures_and_a_video_that_plays(run, tiny_file, tmp_path):
    out, video = tmp_path / "out", tmp_path / "films" / "tiny.mp4"
    code, stdout, _ = run("run", tiny_file, "--out", out, "--video", video, *SIZE)
    assert code == 0
    assert str(video) in stdout
    pictures = sorted((out / "images").iterdir())
    assert [path.name for path in pictures] == [f"frame_0000{k}.png" for k in range(3)]
    with Image.open(pictures[0]) as picture:
        assert picture.size == (64, 48)
        assert np.asarray(picture).std() > 1  # something is to be seen
    with av.open(str(video)) as movie:
        stream = movie.streams.video[0]
        assert (stream.codec_context.name, stream.codec_context.pix_fmt) == ("h264", "yuv420p")
        assert stream.average_rate == 20
        assert [(f.width, f.height) for f in movie.decode(stream)] == [(64, 48)] * 3


@pytest.mark.gl
def test_a_finished_run_is_rendered_again_from_another_camera(run, tiny_file, tmp_path):
    out, video = tmp_path / "out", tmp_path / "again.mp4"
    run("run", tiny_file, "--out", out, *SIZE)
    before = (out / "images/frame_00002.png").read_bytes()
    particles = (out / "particles/frame_00002.npz").read_bytes()
    code, *_ = run("render", out, "--camera", "eye=[2, 2, 2]", "--video", video)
    assert code == 0
    assert (out / "images/frame_00002.png").read_bytes() != before
    assert (out / "particles/frame_00002.npz").read_bytes() == particles
    with Image.open(out / "images/frame_00002.png") as picture:
        assert picture.size == (64, 48)  # that of the run
    with av.open(str(video)) as movie:
        assert len(list(movie.decode(video=0))) == 3


@pytest.mark.gl
def test_rendering_again_without_changes_gives_the_same_pictures(run, tiny_file, tmp_path):
    out = tmp_path / "out"
    run("run", tiny_file, "--out", out, *SIZE)
    before = (out / "images/frame_00001.png").read_bytes()
    run("render", out)
    assert (out / "images/frame_00001.png").read_bytes() == before


def test_a_shorter_run_leaves_nothing_of_the_longer_one_before(run, tiny_file, tmp_path):
    out = tmp_path / "out"
    run("run", tiny_file, "--out", out, "--no-render")
    run("run", tiny_file, "--out", out, "--no-render", "--frames", 1)
    assert files_in(out) == ["particles/frame_00000.npz", "run.json"]


def test_frames_threads_and_set_change_the_run(run, tiny_file, tmp_path):
    out = tmp_path / "out"
    options = [
        "--frames",
        2,
        "--threads",
        1,
        "--set",
        "spacing=0.1",
        "--set",
        "kernel=cubic_spline",
    ]
    run("run", tiny_file, "--out", out, "--no-render", *options)
    record = record_of(out)
    assert len(record["frames"]) == 2
    assert record["threads"] == 1
    assert record["scene"]["fluid"]["kernel"] == "cubic_spline"
    assert record["frames"][0]["particles"] == 8


def test_the_directory_is_named_after_the_scene(run, tiny_file, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    code, stdout, _ = run("run", "tiny.toml", "--no-render", "--frames", 1)
    assert code == 0
    assert "out/tiny/run.json" in stdout
    assert (tmp_path / "out/tiny/run.json").exists()


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["run", "dam_brake"], 'did you mean "dam_break"?'),
        (["run", "nowhere.toml"], "nowhere.toml: cannot be read"),
        (["run", "dam_break", "--size", "1280"], "size = 1280: expected WIDTHxHEIGHT"),
        (["run", "dam_break", "--size", "63x48", "--video", "a.mp4"], "must be even"),
        (["run", "dam_break", "--video", "a.avi"], "a.avi: must end in .mp4"),
        (["run", "dam_break", "--video", "a.mp4", "--no-render"], "no pictures without rendering"),
        (["run", "dam_break", "--threads", "-1"], "solver.num_threads = -1: must be"),
        (["run", "dam_break", "--set", "spacing=-1"], "fluid.spacing = -1 m: must be"),
        (["run", "dam_break", "--set", "spacing"], "--set spacing: expected KEY=VALUE"),
        (["run", "dam_break", "--set", "spacing=[1"], "--set spacing=[1: not TOML"),
        (["run", "dam_break", "--set", "spacing=0.1\nduration=0"], "expected one value, got lines"),
        (["run", "dam_break", "--set", "spacing=0.1\n[x]"], "expected one value, got lines"),
        (["render", "."], ".: not the directory of a run"),
        (["run"], "Missing argument"),
        (["run", "dam_break", "--frames", "0"], "Invalid value for '--frames'"),
        (["fly"], "No such command"),
    ],
)
def test_bad_input_ends_with_code_2_and_a_message(run, tmp_path, monkeypatch, arguments, message):
    monkeypatch.chdir(tmp_path)
    code, stdout, stderr = run(*arguments)
    assert code == 2
    assert message in stderr
    assert "Traceback" not in stderr
    assert stdout == ""
    assert not list(tmp_path.iterdir())


def test_debug_shows_the_traceback(tmp_path):
    with pytest.raises(pbf.FluidError):
        main(["run", "dam_brake", "--debug"])


def test_a_failure_ends_with_code_1_and_keeps_the_frames_before(
    run, tiny_file, tmp_path, monkeypatch
):
    advance = pbf.Simulation.advance

    def fail_late(self, seconds):
        if self.time > 0:
            raise pbf.errors.SimulationFailed("positions are not finite")
        return advance(self, seconds)

    monkeypatch.setattr(pbf.Simulation, "advance", fail_late)
    out = tmp_path / "out"
    code, _, stderr = run("run", tiny_file, "--out", out, "--no-render")
    assert code == 1
    assert "pbfluids: positions are not finite" in stderr
    record = record_of(out)
    assert record["status"] == "failed: positions are not finite"
    assert len(record["frames"]) == 2
    assert len(list((out / "particles").iterdir())) == 2


def test_a_directory_that_cannot_be_made_ends_with_code_1(run, tiny_file, tmp_path):
    code, _, stderr = run("run", tiny_file, "--out", tiny_file / "out", "--no-render")
    assert code == 1
    assert "Not a directory" in stderr


@pytest.mark.gl
def test_color_paints_a_run_and_paints_it_again_by_something_else(run, tiny_file, tmp_path):
    def picture():
        with Image.open(out / "images/frame_00002.png") as opened:
            return np.asarray(opened).copy()

    out = tmp_path / "out"
    held = ("--fields", "pressure")
    assert run("run", tiny_file, "--out", out, *SIZE, "--color", "speed", *held)[0] == 0
    pictures = {"speed": picture()}
    for attribute in ("pressure", "id"):
        assert run("render", out, "--color", attribute)[0] == 0
        pictures[attribute] = picture()
    assert run("render", out, "--set", "render.color_by=speed")[0] == 0
    assert np.array_equal(picture(), pictures["speed"])
    assert not np.array_equal(pictures["speed"], pictures["pressure"])
    assert not np.array_equal(pictures["pressure"], pictures["id"])


@pytest.mark.gl
@pytest.mark.parametrize("field", ["pressure", "density"])
def test_a_field_is_there_if_the_run_was_colored_by_it(run, tiny_file, tmp_path, field):
    out = tmp_path / "out"
    assert run("run", tiny_file, "--out", out, *SIZE)[0] == 0
    code, _, stderr = run("render", out, "--color", field)
    assert code == 2
    assert f'color_by = "{field}": the frame holds none; simulate again with it' in stderr
    assert f"pbfluids run --fields {field}" in stderr
    assert run("run", tiny_file, "--out", out, *SIZE, "--color", field)[0] == 0
    assert run("render", out)[0] == 0


def test_the_files_hold_the_fields_that_were_asked_for(run, tiny_file, tmp_path):
    out = tmp_path / "out"
    asked = ("--fields", "pressure, density")
    assert run("run", tiny_file, "--out", out, "--no-render", *asked)[0] == 0
    *_, last = pbf.Scene.load(tiny_file).frames(fields=["density", "pressure"])
    with np.load(out / "particles/frame_00002.npz") as arrays:
        np.testing.assert_array_equal(arrays["pressures"], last.pressures)
        np.testing.assert_array_equal(arrays["densities"], last.densities)
    before = (out / "run.json").read_bytes()
    code, _, stderr = run("run", tiny_file, "--out", out, "--no-render", "--fields", "speed")
    assert code == 2
    assert 'fields: "speed" is unknown; must be "pressure" or "density"' in stderr
    assert (out / "run.json").read_bytes() == before


def test_a_damaged_frame_is_named(run, tiny_file, tmp_path):
    out = tmp_path / "out"
    run("run", tiny_file, "--out", out, "--no-render")
    frame = out / "particles/frame_00001.npz"
    frame.write_bytes(frame.read_bytes()[:100])
    with pytest.raises(pbf.errors.InvalidParameter, match=r"frame_00001\.npz: not a frame"):
        RunDirectory(out).read_particles(1)


def test_ctrl_c_ends_with_code_130_and_complete_files(tiny_file, tmp_path):
    out = tmp_path / "out"
    # Tests that run in the background inherit that Ctrl-C is ignored; a user's shell does not.
    code = (
        "import signal, sys; signal.signal(signal.SIGINT, signal.default_int_handler);"
        "from pbfluids.cli import main; sys.exit(main())"
    )
    command = [sys.executable, "-c", code, "run", str(tiny_file), "--out", str(out)]
    command += ["--no-render", "--set", "duration=1e6"]
    with subprocess.Popen(command, stderr=subprocess.PIPE, text=True) as process:
        while not (out / "particles/frame_00003.npz").exists():
            assert process.poll() is None
            time.sleep(0.01)
        process.send_signal(signal.SIGINT)
        _, stderr = process.communicate(timeout=60)
    assert process.returncode == 130
    assert "pbfluids: interrupted" in stderr
    assert "Traceback" not in stderr
    record = record_of(out)
    assert record["status"] == "interrupted"
    frames = sorted((out / "particles").iterdir())
    assert len(frames) in (len(record["frames"]), len(record["frames"]) + 1)
    for path in frames:
        with np.load(path) as arrays:
            assert arrays["positions"].shape == (64, 3)


def test_progress_is_a_bar_on_a_terminal_and_plain_lines_elsewhere(tiny_file, tmp_path):
    command = [sys.executable, "-m", "pbfluids", "run", str(tiny_file), "--no-render"]
    command += ["--out", str(tmp_path / "out")]
    plain = subprocess.run(command, capture_output=True, text=True, check=True)
    assert "\x1b" not in plain.stderr
    assert plain.stderr.endswith("0 s left\n")

    ours, theirs = pty.openpty()
    environment = {**os.environ, "TERM": "xterm"}
    with subprocess.Popen(
        command, stderr=theirs, stdout=subprocess.PIPE, env=environment
    ) as process:
        os.close(theirs)
        shown = b""
        while chunk := _read(ours):
            shown += chunk
    os.close(ours)
    assert process.returncode == 0
    assert b"\x1b" in shown
    assert b"3/3" in shown
    assert b"64 particles" in shown


def _read(terminal):
    try:
        return os.read(terminal, 4096)
    except OSError:  # the other end is closed
        return b""


def test_scenes_lists_each_with_its_particles(run):
    code, stdout, _ = run("scenes")
    assert code == 0
    lines = stdout.splitlines()
    assert [line.split()[0] for line in lines] == pbf.Scene.names()
    for line, name in zip(lines, pbf.Scene.names(), strict=True):
        scene = pbf.Scene.builtin(name)
        assert f"{len(scene.particles()[0]):,} particles" in line
        assert scene.description in line


def test_schema_prints_the_json_schema(run):
    code, stdout, _ = run("schema")
    assert code == 0
    assert json.loads(stdout) == pbf.Scene.json_schema()


def test_version_prints_the_version(run):
    assert run("--version") == (0, f"{pbf.__version__}\n", "")


@pytest.mark.parametrize("missing", ["typer", "rich"])
def test_a_missing_extra_is_one_line_that_names_it(outside, missing):
    done = outside(
        f"import sys; sys.modules['{missing}'] = None\n"
        "from pbfluids.cli import main\n"
        "sys.exit(main(['scenes']))"
    )
    assert done.returncode == 1
    assert done.stderr == (
        "pbfluids: the command line needs typer and rich: pip install 'pbfluids[cli]'\n"
    )
