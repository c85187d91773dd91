"""What the fluid is and how it is solved: the fields of the library's parameter objects."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


def as_float32(value: Any) -> Array:
    """The value that the library computes with: its parameters are float32, printed shortly."""
    return np.asarray(value, dtype=np.float32).astype(np.float64)


@dataclass(frozen=True)
class Box:
    """The closed box lower <= x <= upper [m]; along a periodic axis it has no walls."""

    lower: Array
    upper: Array
    periodic: tuple[bool, bool, bool] = (False, False, False)

    @property
    def period(self) -> Array:
        """Distance of a particle's images per axis [m], infinite along an axis with walls."""
        return np.where(self.periodic, np.subtract(self.upper, self.lower), np.inf)

    @classmethod
    def of(cls, box: Any) -> Box | None:
        """The same box as the library's, None for open space."""
        if box is None:
            return None
        return cls(as_float32(box.lower), as_float32(box.upper), box.periodic)


@dataclass(frozen=True)
class Fluid:
    """What the fluid is. SI units."""

    spacing: float
    support_radius: float | None = None
    rest_density: float = 1000.0
    gravity: tuple[float, float, float] = (0.0, -9.81, 0.0)
    kernel: str = "poly6_spiky"
    dimensions: int = 3

    @property
    def h(self) -> float:
        """The support radius in force [m]."""
        return 2.0 * self.spacing if self.support_radius is None else self.support_radius

    @classmethod
    def of(cls, fluid: Any) -> Fluid:
        """The same fluid as the library's FluidParams."""
        radius = fluid.support_radius
        return cls(
            spacing=float(as_float32(fluid.spacing)),
            support_radius=None if radius is None else float(as_float32(radius)),
            rest_density=float(as_float32(fluid.rest_density)),
            gravity=tuple(as_float32(fluid.gravity).tolist()),
            kernel=fluid.kernel or "poly6_spiky",
            dimensions=fluid.dimensions,
        )


@dataclass(frozen=True)
class Solver:
    """How the constraint is solved: one time step's worth, so neither substeps nor threads."""

    iterations: int | None = None
    method: str | None = None
    min_iterations: int = 2
    max_iterations: int = 100
    tolerance: float = 0.001
    max_tolerance: float = math.inf
    compliance: float = 0.0
    warm_start: float = 0.25
    levels: int = 2
    acceleration: str = "nesterov"
    relaxation: float = 0.01
    constraint_floor: float | None = -math.inf
    tensile_strength: float = 0.0
    tensile_distance: float = 0.2
    tensile_exponent: int = 4
    vorticity: float = 0.0
    xsph: float = 0.0

    @classmethod
    def of(cls, solver: Any) -> Solver:
        """The same solver as the library's SolverParams."""
        values = {name: getattr(solver, name) for name in cls.__dataclass_fields__}
        made = cls(
            **{k: float(as_float32(v)) if isinstance(v, float) else v for k, v in values.items()}
        )
        if made.constraint_floor is None:
            floor = -0.002 if made.method_in_force == "plain" else 0.0
            made = replace(made, constraint_floor=float(as_float32(floor)))
        return made

    @property
    def method_in_force(self) -> str:
        """Counting iterations is the paper's way."""
        return self.method or ("pressure" if self.iterations is None else "plain")
