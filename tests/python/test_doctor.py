"""The doctor finds what is there and what is missing."""

from __future__ import annotations

import json
import os

import pytest

import pbfluids as pbf
from pbfluids import _core, diagnosis
from pbfluids.cli import main
from pbfluids.errors import RendererUnavailable


@pytest.fixture
def no_renderer(monkeypatch):
    def fail(width, height):
        raise RendererUnavailable("no EGL device\ncure: apt-get install libegl1 libgl1-mesa-dri")

    monkeypatch.setattr(diagnosis, "Renderer", fail)


@pytest.mark.gl
def test_the_doctor_says_what_is_installed():
    text = pbf.doctor()
    assert pbf.__version__ in text
    assert f"{len(os.sched_getaffinity(0))}, " in text
    assert "rendering        yes" in text


@pytest.mark.gl
def test_the_doctor_shows_the_devices_the_choice_and_why(monkeypatch):
    found = diagnosis.examine()
    names = [device["name"] for device in found.egl_devices]
    assert [device["index"] for device in found.egl_devices] == list(range(len(names)))
    assert f"EGL devices      {', '.join(names) or 'none'}\n" in found.text()
    assert found.renderer["choice"]
    assert f"choice           {found.renderer['choice']}\n" in found.text()
    monkeypatch.setenv("PBF_EGL_DEVICE", "surfaceless")
    assert "choice           asked for by PBF_EGL_DEVICE = surfaceless\n" in pbf.doctor()
    monkeypatch.setenv("PBF_EGL_DEVICE", "gpu")
    wrong = diagnosis.examine()
    assert not wrong.can_render
    assert "PBF_EGL_DEVICE = gpu: must be the index" in wrong.text()
    assert wrong.egl_devices == found.egl_devices


@pytest.mark.gl
def test_the_doctor_tells_of_a_gpu_beside_software_and_warns_nobody(monkeypatch):
    monkeypatch.setattr(_core, "visible_gpus", lambda: ["/dev/dri/renderD128"])
    assert "GPUs             /dev/dri/renderD128\n" in pbf.doctor()  # warnings are errors here


def test_the_doctor_lists_the_instruction_sets_that_can_be_used(no_renderer):
    usable = _core.instruction_sets()
    assert f"instruction sets {', '.join(usable)}\n" in pbf.doctor()
    assert diagnosis.examine().build["instruction_sets"] == usable
    assert diagnosis.examine().build["instruction_set"] in usable


@pytest.mark.gl
def test_json_has_the_same_and_the_driver(capsys):
    assert main(["doctor", "--json"]) == 0
    found = json.loads(capsys.readouterr().out)
    assert found["can_render"] is True
    assert found["renderer"]
    assert found["renderer_error"] is None
    assert found["build"]["instruction_set"]
    assert found["extras"]["cli"]["installed"] is True


def test_without_a_driver_it_ends_with_code_1_and_the_cure(no_renderer, capsys):
    assert main(["doctor"]) == 1
    text = capsys.readouterr().out
    assert "rendering        NO" in text
    assert "apt-get install libegl1 libgl1-mesa-dri" in text


def test_without_a_driver_json_says_why(no_renderer, capsys):
    assert main(["doctor", "--json"]) == 1
    found = json.loads(capsys.readouterr().out)
    assert found["can_render"] is False
    assert found["renderer_error"].startswith("no EGL device")


def test_a_missing_extra_is_named_with_its_cure(monkeypatch, no_renderer):
    monkeypatch.setitem(diagnosis._EXTRAS, "video", ["a-package-that-is-not-there"])
    extra = diagnosis.examine().extras["video"]
    assert extra.packages == {"a-package-that-is-not-there": None}
    assert not extra.installed
    assert "missing: pip install 'pbfluids[video]'" in diagnosis.doctor()


@pytest.mark.gl
def test_a_machine_without_egl_is_told_what_to_install(outside):
    # The loader finds no library under this name when the search is led to an empty place.
    done = outside(
        "from pbfluids import diagnosis\n"
        "found = diagnosis.examine()\n"
        "print(found.can_render, found.text())",
        PATH="/usr/bin:/bin",
        __EGL_VENDOR_LIBRARY_DIRS="/nonexistent",
    )
    assert done.returncode == 0, done.stderr
    assert done.stdout.startswith("True")  # by C++
    assert "no OpenGL context could be made" in done.stdout
    assert "apt" in done.stdout
