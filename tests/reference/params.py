"""What the fluid is and how it is solved: the fields of the library's parameter objects."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Box:
    """The closed box lower <= x <= upper [m]."""

    lower: Array
    upper: Array

    @classmethod
    def of(cls, box: Any) -> Box | None:
        """The same box as the library's, None for open space."""
        if box is None:
            return None
        return cls(np.asarray(box.lower, float), np.asarray(box.upper, float))


@dataclass(frozen=True)
class Fluid:
    """What the fluid is. SI units."""

    spacing: float
    support_radius: float | None = None
    rest_density: float = 1000.0
    gravity: tuple[float, float, float] = (0.0, -9.81, 0.0)
    kernel: str = "poly6_spiky"

    @property
    def h(self) -> float:
        """The support radius in force [m]."""
        return 2.0 * self.spacing if self.support_radius is None else self.support_radius

    @classmethod
    def of(cls, fluid: Any) -> Fluid:
        """The same fluid as the library's FluidParams, whose numbers are already float32."""
        return cls(**fluid.as_dict())


@dataclass(frozen=True)
class Solver:
    """How the constraint is solved: one time step's worth, so neither substeps nor threads."""

    iterations: int = 4
    relaxation: float = 0.01
    constraint_floor: float = -math.inf
    tensile_strength: float = 0.0
    tensile_distance: float = 0.2
    tensile_exponent: int = 4
    vorticity: float = 0.0
    xsph: float = 0.0

    @classmethod
    def of(cls, solver: Any) -> Solver:
        """The same solver as the library's SolverParams."""
        return cls(**{name: getattr(solver, name) for name in cls.__dataclass_fields__})
