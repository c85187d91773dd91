"""MP4 that plays in every browser: H.264, yuv420p, BT.709, index in front."""

from __future__ import annotations

from fractions import Fraction
from pathlib import Path
from types import TracebackType
from typing import Any

import numpy as np
import numpy.typing as npt

from pbfluids import _core, files
from pbfluids.errors import InvalidParameter, MissingExtra

__all__ = ["VideoWriter", "check"]

_BT709 = 1  # of primaries, transfer and matrix alike, ITU-T H.273
_LIMITED_RANGE = 1


def check(path: str | Path, width: int, height: int) -> None:
    """Check that a video can be made.

    Parameters
    ----------
    path
        Where to, ending in .mp4.
    width, height
        Size in pixels, even.

    Raises
    ------
    InvalidParameter
        If the size is odd, or the name does not end in .mp4 or is that of a directory.
    MissingExtra
        If PyAV is not installed.
    """
    if Path(path).suffix.lower() != ".mp4":
        raise InvalidParameter(f"video = {path}: must end in .mp4")
    if Path(path).is_dir():
        raise InvalidParameter(f"video = {path}: is a directory; must be a file")
    if width % 2 or height % 2:
        raise InvalidParameter(
            f"size = {width}x{height}: must be even in both directions, since yuv420p keeps one "
            f"color for 2x2 pixels; try {width + width % 2}x{height + height % 2}"
        )
    _av()


def _av() -> Any:
    try:
        import av
    except ImportError as error:
        raise MissingExtra("video needs PyAV: pip install 'pbfluids[video]'") from error
    return av


class VideoWriter:
    """Writes images to an MP4 file; a context manager.

    The file appears under its name at the end, complete; after an exception it holds the images
    that came before. Without any image there is no file.

    Parameters
    ----------
    path
        Where to, ending in .mp4.
    width, height
        Size in pixels, even.
    frame_rate
        Images per second.

    Raises
    ------
    InvalidParameter
        If the size is odd, or the name does not end in .mp4 or is that of a directory.
    MissingExtra
        If PyAV is not installed.
    """

    def __init__(self, path: str | Path, width: int, height: int, frame_rate: float) -> None:
        check(path, width, height)
        self._av = _av()
        self.path = Path(path)
        self._size = (width, height)
        self._images = 0
        self._file = files.Replacement(self.path)
        self._container = self._av.open(
            str(self._file.beside), "w", format="mp4", options={"movflags": "+faststart"}
        )
        self._stream = self._container.add_stream(
            "libx264", rate=Fraction(frame_rate).limit_denominator(1001)
        )
        self._stream.width, self._stream.height = width, height
        self._stream.pix_fmt = "yuv420p"
        self._stream.options = {"crf": "18", "preset": "medium"}
        context = self._stream.codec_context
        context.color_primaries = context.color_trc = context.colorspace = _BT709
        context.color_range = _LIMITED_RANGE
        context.thread_count = _core.usable_threads(0)  # x264 would take half as many again

    def write(self, image: npt.NDArray[np.uint8]) -> None:
        """Append an image.

        Parameters
        ----------
        image
            Shape (height, width, 3 or 4), uint8, sRGB, row 0 on top; alpha is ignored.

        Raises
        ------
        InvalidParameter
            If the image has another shape or dtype.
        """
        width, height = self._size
        if image.shape[:2] != (height, width) or image.ndim != 3 or image.dtype != np.uint8:
            raise InvalidParameter(
                f"image: expected shape ({height}, {width}, 3 or 4) and dtype uint8, got "
                f"{image.shape} and {image.dtype}"
            )
        frame = self._av.VideoFrame.from_ndarray(np.ascontiguousarray(image[:, :, :3]), "rgb24")
        frame = frame.reformat(
            format="yuv420p", dst_colorspace="ITU709", dst_color_range="MPEG", interpolation="AREA"
        )
        self._container.mux(self._stream.encode(frame))
        self._images += 1

    def __enter__(self) -> VideoWriter:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        if self._images == 0:
            self._container.close()
            self._file.discard()
            return
        with self._file:
            self._container.mux(self._stream.encode(None))
            self._container.close()
