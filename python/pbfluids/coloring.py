"""What a scene's particles may be colored by."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from pbfluids.errors import InvalidParameter

if TYPE_CHECKING:
    from pbfluids.scene import Scene

__all__ = ["LEGENDS", "check_fields", "colors_of_scene", "values"]

# Each attribute and what its legend says.
LEGENDS = {
    "speed": "speed [m/s]",
    "density": "density [kg/m³]",
    "pressure": "pressure [Pa]",
    "id": "",
}
_STORED_AS = {"density": "densities", "pressure": "pressures", "id": "ids"}
# Those that cost time, which a frame holds only if it is asked to.
_FIELDS = ("pressure", "density")


def check_fields(fields: Sequence[str]) -> None:
    """Check the names of what a frame shall hold.

    Raises
    ------
    InvalidParameter
        If it cannot hold one of them.
    """
    for name in fields:
        if name not in _FIELDS:
            known = " or ".join(f'"{field}"' for field in _FIELDS)
            raise InvalidParameter(f'fields: "{name}" is unknown; must be {known}')


def values(attribute: str, frame: Mapping[str, Any]) -> npt.NDArray[np.float32]:
    """Give the attribute of a frame's particles, shape (n,).

    Parameters
    ----------
    attribute
        One of `LEGENDS`.
    frame
        Arrays by name, as a frame of a run has them.

    Raises
    ------
    InvalidParameter
        If the frame does not hold what is needed.
    """
    if attribute == "speed":
        speed: npt.NDArray[np.float32] = np.linalg.norm(frame["velocities"], axis=1)
        return speed
    stored = frame.get(_STORED_AS[attribute])
    if stored is None:
        raise InvalidParameter(
            f'color_by = "{attribute}": the frame holds none; simulate again with it '
            f"among the fields (pbfluids run --fields {attribute})"
        )
    # Only the last digits of an id count, of which float32 holds all.
    return np.asarray(stored % 2**24 if attribute == "id" else stored, np.float32)


def colors_of_scene(scene: Scene, attribute: str) -> dict[str, Any]:
    """Give the render parameters that a scene's colors have if it does not say.

    The range holds for all frames, so that they can be compared: from 0 to the speed of something
    that falls from the fluid's top to the tank's bottom, or the pressure there if it were at rest.
    """
    if attribute == "id":
        return {"colormap": "shuffled"}
    fluid = scene.fluid
    if attribute == "density":
        limits = (0.97 * fluid.rest_density, 1.03 * fluid.rest_density)
    else:
        positions, velocities = (rows.astype(float) for rows in scene.particles())
        start2 = float((velocities**2).sum(axis=1).max())
        gravity = np.asarray(fluid.gravity, float)
        size = float(np.linalg.norm(gravity))
        drop = math.sqrt(start2) * scene.duration + size * scene.duration**2 / 2
        if scene.domain is not None:
            heights = -positions @ gravity
            corners = np.stack([scene.domain.lower, scene.domain.upper]) * -gravity
            drop = float(heights.max() - corners.min(axis=0).sum()) / max(size, 1e-30)
        energy = start2 / 2 + size * drop  # of a kilogram [J]
        most = math.sqrt(2 * energy) if attribute == "speed" else fluid.rest_density * energy
        limits = (0.0, most if most > 0 else 1.0)
    return {"color_range": limits, "legend": LEGENDS[attribute]}
