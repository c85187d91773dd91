"""The directory of a run: ``run.json``, ``particles/`` and ``images/``."""

from __future__ import annotations

import io
import json
import math
import zipfile
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from pbfluids import files, png
from pbfluids.errors import InvalidParameter
from pbfluids.scene import Frame

__all__ = ["RunDirectory"]

_PARTICLES = "particles/frame_{:05d}.npz"
_IMAGE = "images/frame_{:05d}.png"
# Those, and what a killed run left beside them; a picture of another name is not ours to remove.
_IMAGES = ["images/frame_*.png", "images/.*.frame_*.png"]
_PARTICLE_FILES = ["particles/frame_*.npz", "particles/.*.frame_*.npz"]


class RunDirectory:
    """Reads and writes the files of a run. Each file is complete or not there.

    Parameters
    ----------
    path
        The directory; need not exist yet.
    """

    def __init__(self, path: str | Path) -> None:
        self.path = Path(path)
        self.record_file = self.path / "run.json"

    def prepare(self, *, particles: bool) -> None:
        """Make the directory, and remove an earlier run's images and, if asked, particles.

        Without this the frames of a shorter run would mix with those of a longer one before it.
        """
        kinds = [*_IMAGES, *([*_PARTICLE_FILES, "run.json"] if particles else [])]
        self.path.mkdir(parents=True, exist_ok=True)
        for old in [file for kind in kinds for file in self.path.glob(kind)]:
            old.unlink()

    def write_particles(self, frame: Frame) -> str:
        """Write the fluid of a frame; give the file's name inside the directory."""
        name = _PARTICLES.format(frame.index)
        data = io.BytesIO()
        arrays: dict[str, Any] = {
            "positions": frame.positions,
            "velocities": frame.velocities,
            "ids": frame.ids,
            "time": np.float64(frame.time),
            "pressures": frame.pressures,
            "densities": frame.densities,
        }
        np.savez(data, **{name: array for name, array in arrays.items() if array is not None})
        files.write(self.path / name, data.getvalue())
        return name

    def write_image(self, index: int, image: npt.NDArray[np.uint8]) -> str:
        """Write the picture of a frame; give the file's name inside the directory."""
        name = _IMAGE.format(index)
        files.write(self.path / name, png.encode(image))
        return name

    def frame_indices(self) -> list[int]:
        """Give the numbers of the frames whose particles are there, in order."""
        names = (file.stem.removeprefix("frame_") for file in self.path.glob("particles/*.npz"))
        return sorted(int(name) for name in names if name.isdecimal())

    def read_particles(self, index: int) -> dict[str, npt.NDArray[Any]]:
        """Read the arrays of a frame, its positions among them.

        Raises
        ------
        InvalidParameter
            If the file is damaged.
        """
        file = self.path / _PARTICLES.format(index)
        try:
            with file.open("rb") as stream, np.load(stream, allow_pickle=False) as arrays:
                particles = {name: arrays[name] for name in {*arrays.files, "positions"}}
        except (OSError, ValueError, KeyError, EOFError, zipfile.BadZipFile) as error:
            raise InvalidParameter(f"{file}: not a frame of particles: {error}") from error
        return particles

    def write_record(self, record: Mapping[str, Any]) -> None:
        """Write ``run.json``."""
        text = json.dumps(_without_infinities(record), indent=1, allow_nan=False)
        files.write(self.record_file, text.encode() + b"\n")

    def read_record(self) -> dict[str, Any]:
        """Read ``run.json``.

        Raises
        ------
        InvalidParameter
            If it is missing or damaged.
        """
        try:
            record = json.loads(self.record_file.read_text(encoding="utf-8"))
        except (OSError, ValueError, RecursionError) as error:
            reason = getattr(error, "strerror", None) or error
            raise InvalidParameter(
                f"{self.path}: not the directory of a run: run.json cannot be read: {reason}"
            ) from error
        if not isinstance(record, dict) or not isinstance(record.get("scene"), dict):
            raise InvalidParameter(f"{self.record_file}: holds no scene")
        size = record.get("size")
        if size is not None and not _is_size(size):
            raise InvalidParameter(
                f"{self.record_file}: size = {json.dumps(size)}: must be width and height"
            )
        return record


def _is_size(value: Any) -> bool:
    return isinstance(value, list) and [type(side) for side in value] == [int, int]


def _without_infinities(value: Any) -> Any:
    """Put infinities into words, which scenes understand: JSON has none."""
    if isinstance(value, Mapping):
        return {key: _without_infinities(item) for key, item in value.items()}
    if isinstance(value, list):
        return [_without_infinities(item) for item in value]
    return str(value) if isinstance(value, float) and math.isinf(value) else value
