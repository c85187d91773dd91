"""PNG files, written with zlib alone, so that pictures need no extra package."""

from __future__ import annotations

import struct
import zlib

import numpy as np
import numpy.typing as npt

from pbfluids.errors import InvalidParameter

__all__ = ["encode"]

_COLOR_TYPE = {3: 2, 4: 6}  # RGB, RGBA


def encode(image: npt.NDArray[np.uint8]) -> bytes:
    """Encode an image as PNG (ISO/IEC 15948).

    Parameters
    ----------
    image
        Shape (height, width, 3 or 4), uint8, sRGB, row 0 on top.

    Raises
    ------
    InvalidParameter
        If the image has another shape or dtype.
    """
    image = np.asarray(image)
    if image.ndim != 3 or image.shape[2] not in _COLOR_TYPE or image.dtype != np.uint8:
        raise InvalidParameter(
            f"image: expected shape (height, width, 3 or 4) and dtype uint8, got {image.shape} "
            f"and {image.dtype}"
        )
    height, width, channels = image.shape
    # Filter 1, Sub: each pixel as its difference from the one to its left, which compresses smooth
    # images. Level 1 takes half the time of 3 and makes files 11 % larger.
    rows = np.empty((height, 1 + width * channels), np.uint8)
    rows[:, 0] = 1
    pixels = image.reshape(height, -1)
    rows[:, 1 : 1 + channels] = pixels[:, :channels]
    np.subtract(pixels[:, channels:], pixels[:, :-channels], out=rows[:, 1 + channels :])
    header = struct.pack(">IIBBBBB", width, height, 8, _COLOR_TYPE[channels], 0, 0, 0)
    return b"\x89PNG\r\n\x1a\n" + b"".join(
        [
            _chunk(b"IHDR", header),
            _chunk(b"sRGB", b"\0"),
            _chunk(b"IDAT", zlib.compress(rows.tobytes(), 1)),
            _chunk(b"IEND", b""),
        ]
    )


def _chunk(kind: bytes, data: bytes) -> bytes:
    return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
