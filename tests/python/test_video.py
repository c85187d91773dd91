"""MP4 and PNG files hold the pictures they were given, and play everywhere."""

from __future__ import annotations

import io

import av
import numpy as np
import pytest
from PIL import Image

from pbfluids import png
from pbfluids.errors import InvalidParameter, MissingExtra
from pbfluids.video import VideoWriter

COLORS = [(255, 0, 0), (0, 255, 0), (0, 0, 255), (200, 120, 40), (255, 255, 255), (0, 0, 0)]


def flat(color, width=64, height=48, channels=3):
    image = np.full((height, width, channels), 255, np.uint8)
    image[:, :, :3] = color
    return image


def write(path, images, rate=30):
    height, width, _ = images[0].shape
    with VideoWriter(path, width, height, rate) as movie:
        for image in images:
            movie.write(image)


def test_a_video_is_h264_yuv420p_bt709_with_every_frame(tmp_path):
    path = tmp_path / "colors.mp4"
    write(path, [flat(color, channels=4) for color in COLORS])
    with av.open(str(path)) as movie:
        stream = movie.streams.video[0]
        codec = stream.codec_context
        frames = list(movie.decode(stream))
        assert (codec.name, codec.pix_fmt) == ("h264", "yuv420p")
        assert (codec.width, codec.height) == (64, 48)
        assert stream.average_rate == 30
        assert (codec.color_primaries, codec.color_trc, codec.colorspace) == (1, 1, 1)
        assert codec.color_range == 1  # limited, what players expect
    assert len(frames) == len(COLORS)
    # Y of BT.709 in limited range is 16 + 219 (0.2126 R + 0.7152 G + 0.0722 B).
    for frame, color in zip(frames, COLORS, strict=True):
        luma = 16 + 219 * np.dot([0.2126, 0.7152, 0.0722], color) / 255
        assert frame.to_ndarray()[24, 32] == pytest.approx(luma, abs=1.5)
        decoded = frame.to_ndarray(format="rgb24")[24, 32]
        assert decoded == pytest.approx(np.array(color), abs=3)


def test_the_index_stands_before_the_pictures_so_that_browsers_can_start(tmp_path):
    path = tmp_path / "movie.mp4"
    write(path, [flat((9, 9, 9))])
    data = path.read_bytes()
    assert 0 < data.index(b"moov") < data.index(b"mdat")


@pytest.mark.parametrize("rate", [24, 60, 23.976, 29.97])
def test_the_frame_rate_is_kept(tmp_path, rate):
    path = tmp_path / "movie.mp4"
    write(path, [flat((9, 9, 9))] * 4, rate)
    with av.open(str(path)) as movie:
        assert float(movie.streams.video[0].average_rate) == pytest.approx(rate, rel=1e-4)


@pytest.mark.parametrize(("width", "height", "even"), [(65, 48, "66x48"), (64, 47, "64x48")])
def test_an_odd_size_is_rejected_with_an_even_one_to_take(tmp_path, width, height, even):
    with pytest.raises(InvalidParameter, match=f"size = {width}x{height}: must be even.*{even}"):
        VideoWriter(tmp_path / "movie.mp4", width, height, 30)
    assert not list(tmp_path.iterdir())


def test_another_ending_is_rejected(tmp_path):
    with pytest.raises(InvalidParameter, match=r"movie\.avi: must end in \.mp4"):
        VideoWriter(tmp_path / "movie.avi", 64, 48, 30)


def test_a_directory_in_its_place_is_found_before_the_first_picture(tmp_path):
    (tmp_path / "movie.mp4").mkdir()
    with pytest.raises(InvalidParameter, match=r"movie\.mp4: is a directory; must be a file"):
        VideoWriter(tmp_path / "movie.mp4", 64, 48, 25)
    assert list(tmp_path.iterdir()) == [tmp_path / "movie.mp4"]


@pytest.mark.parametrize(
    "image", [np.zeros((48, 65, 3), np.uint8), np.zeros((48, 64), np.uint8), np.zeros((48, 64, 3))]
)
def test_an_image_of_another_shape_or_dtype_is_rejected(tmp_path, image):
    movie = VideoWriter(tmp_path / "movie.mp4", 64, 48, 30)
    with movie, pytest.raises(InvalidParameter, match=r"image: expected shape \(48, 64, 3 or 4\)"):
        movie.write(image)
    assert not list(tmp_path.iterdir())


def test_after_an_exception_the_video_holds_the_images_before_it(tmp_path):
    path = tmp_path / "movie.mp4"
    movie = VideoWriter(path, 64, 48, 30)
    movie.write(flat((9, 9, 9)))
    movie.write(flat((9, 9, 9)))
    with pytest.raises(KeyboardInterrupt), movie:
        raise KeyboardInterrupt
    with av.open(str(path)) as decoded:
        assert len(list(decoded.decode(video=0))) == 2
    assert list(tmp_path.iterdir()) == [path]


def test_a_missing_pyav_is_named_with_its_extra(tmp_path, monkeypatch):
    monkeypatch.setitem(__import__("sys").modules, "av", None)
    with pytest.raises(MissingExtra, match=r"pip install 'pbfluids\[video\]'"):
        VideoWriter(tmp_path / "movie.mp4", 64, 48, 30)


@pytest.mark.parametrize("channels", [3, 4])
@pytest.mark.parametrize("size", [(1, 1), (5, 3), (64, 48)])
def test_a_png_holds_the_pixels_it_was_given(channels, size):
    width, height = size
    image = np.random.default_rng(0).integers(0, 256, (height, width, channels)).astype(np.uint8)
    with Image.open(io.BytesIO(png.encode(image))) as decoded:
        assert decoded.mode == ("RGB" if channels == 3 else "RGBA")
        np.testing.assert_array_equal(np.asarray(decoded), image)


def test_a_png_of_another_shape_or_dtype_is_rejected():
    with pytest.raises(InvalidParameter, match="image: expected shape"):
        png.encode(np.zeros((4, 4), np.uint8))
    with pytest.raises(InvalidParameter, match="and float64"):
        png.encode(np.zeros((4, 4, 3)))
