"""What stands around the fluid, from files: opaque meshes, and maps of the light that falls in.

They belong to the picture alone. The fluid is simulated as if they were not there.
"""

from __future__ import annotations

import os
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from pbfluids._core import Mesh
from pbfluids.errors import InvalidParameter, MissingExtra, WrongType

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

__all__ = ["read_environment_map", "read_mesh"]


def read_mesh(
    file: str | Path,
    *,
    position: Sequence[float] = (0.0, 0.0, 0.0),
    scale: float = 1.0,
    rotation: Sequence[float] = (0.0, 0.0, 0.0),
    color: Sequence[float] | None = None,
) -> Mesh:
    """Read an opaque thing to draw: each of the file's points goes to position + R · scale · point.

    Parameters
    ----------
    file
        OBJ, STL, PLY, or another format that trimesh reads. Its colors and textures are left alone.
    position
        Where the file's origin goes [m].
    scale
        How long the file's unit is [m], above 0; 0.001 for millimeters.
    rotation
        Turns about x, then y, then z, through the file's origin [degrees].
    color
        Red, green and blue, linear, 0 to 1; that of `Mesh` if not given.

    Raises
    ------
    InvalidParameter
        If the file is missing, is no mesh, holds no triangles, or is a closed surface turned
        inside out, of which only the inside would be seen; or if a number is out of range.
    WrongType
        If a place is told by no real numbers.
    MissingExtra
        If trimesh is not installed.
    """
    unit = _numbers("scale", scale, ())
    if unit <= 0:
        raise InvalidParameter(f"scale = {scale} m: must be > 0")
    origin = _numbers("position", position, (3,))
    turn = _rotation(_numbers("rotation", rotation, (3,)))
    _look_for(file)
    trimesh = _trimesh()
    try:
        read = trimesh.load_mesh(str(file), process=False, skip_materials=True)
        vertices, faces = np.asarray(read.vertices, float), np.asarray(read.faces)
    except Exception as error:  # whatever a parser makes of a file that is none of its kind
        raise InvalidParameter(f"{file}: trimesh finds no mesh in it: {error}") from error
    if not faces.size:
        raise InvalidParameter(f"{file}: holds no triangles")
    try:
        mesh = Mesh(origin + unit * vertices @ turn.T, faces, *([] if color is None else [color]))
    except InvalidParameter as error:
        raise InvalidParameter(f"{file}: {error}") from error
    welded = trimesh.Trimesh(vertices, faces)  # the triangles of an STL file share no vertex
    if welded.is_watertight and welded.volume < 0:
        raise InvalidParameter(
            f"{file}: is inside out: its triangles are clockwise seen from outside, and only their "
            f"other side is drawn; turn them round, for example by trimesh's Trimesh.invert()"
        )
    return mesh


def read_environment_map(file: str | Path) -> NDArray[np.float32]:
    """Read a panorama of light for `Renderer.set_environment_map`.

    Parameters
    ----------
    file
        Radiance HDR or OpenEXR: linear light in channels R, G and B, from straight up in the first
        row to straight down in the last.

    Returns
    -------
    ndarray, shape (h, w, 3), float32

    Raises
    ------
    InvalidParameter
        If the file is missing or damaged, or holds colors for a screen instead of light.
    MissingExtra
        If OpenImageIO is not installed.
    """
    _look_for(file)
    oiio = _openimageio()
    image = oiio.ImageInput.open(str(file))
    if image is None:
        raise InvalidParameter(f"{file}: no picture of light: {oiio.geterror()}")
    try:
        spec = image.spec()
        if str(spec.format) not in ("half", "float", "double"):
            raise InvalidParameter(
                f"{file}: holds {spec.format}, which are colors for a screen; light takes .hdr or "
                f".exr"
            )
        channels = [spec.channelindex(name) for name in "RGB"]
        if -1 in channels:
            names = ", ".join(spec.channelnames)
            raise InvalidParameter(f"{file}: has the channels {names}; must have R, G and B")
        light = image.read_image("float")
        if light is None:
            raise InvalidParameter(f"{file}: is damaged: {image.geterror()}")
    finally:
        image.close()
    return np.ascontiguousarray(light[..., channels], np.float32)


def _numbers(name: str, value: Any, shape: tuple[int, ...]) -> NDArray[np.float64]:
    try:
        numbers = np.asarray(value, float)
    except (TypeError, ValueError) as error:
        raise WrongType(f"{name} = {value!r}: must be real numbers") from error
    if numbers.shape != shape or not np.isfinite(numbers).all():
        rule = "three finite numbers" if shape else "a finite number"
        raise InvalidParameter(f"{name} = {value}: must be {rule}")
    return numbers


def _rotation(degrees: NDArray[np.float64]) -> NDArray[np.float64]:
    """Turns about x, then y, then z: the matrix Rz Ry Rx."""
    matrix = np.eye(3)
    for axis, angle in enumerate(np.radians(degrees)):
        a, b = (axis + 1) % 3, (axis + 2) % 3
        turn = np.eye(3)
        turn[[a, b], [a, b]] = np.cos(angle)
        turn[a, b], turn[b, a] = -np.sin(angle), np.sin(angle)
        matrix = turn @ matrix
    return matrix


def _look_for(file: str | Path) -> None:
    if not os.path.isfile(file):  # noqa: PTH113 - no name, however odd, makes this raise
        raise InvalidParameter(f"{file}: there is no such file")


def _trimesh() -> Any:
    try:
        import trimesh
    except ImportError as error:
        raise MissingExtra("meshes need trimesh: pip install 'pbfluids[meshes]'") from error
    return trimesh


def _openimageio() -> Any:
    try:
        import OpenImageIO
    except ImportError as error:
        raise MissingExtra(
            "environment maps need OpenImageIO: pip install 'pbfluids[hdr]'"
        ) from error
    return OpenImageIO
