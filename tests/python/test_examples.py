"""The examples run and show what they say."""

from __future__ import annotations

import runpy
from pathlib import Path

import av
import numpy as np
import pytest
from PIL import Image

EXAMPLES = Path(__file__).resolve().parents[2] / "examples"


def main_of(name):
    return runpy.run_path(str(EXAMPLES / name))["main"]


@pytest.mark.gl
def test_the_dam_break_becomes_a_video(tmp_path):
    path = tmp_path / "dam.mp4"
    main_of("01_dam_break.py")(path, spacing=0.08, duration=0.05)
    with av.open(str(path)) as movie:
        assert len(list(movie.decode(video=0))) == 4


@pytest.mark.gl
def test_a_cloud_becomes_a_picture(tmp_path):
    example = runpy.run_path(str(EXAMPLES / "02_render_a_cloud.py"))
    example["main"](example["torus"](2000), tmp_path / "cloud.png", None)
    with Image.open(tmp_path / "cloud.png") as picture:
        assert np.asarray(picture).std() > 1


def test_the_corrected_curl_is_exact_to_the_surface(capsys):
    errors = main_of("03_fields.py")()
    assert errors["corrected"] < 1e-3
    assert errors["plain"] > 1.0
    assert "corrected" in capsys.readouterr().out
