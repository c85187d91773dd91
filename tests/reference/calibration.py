"""Particle volume and the scale of the multipliers, both from the rest lattice."""

from __future__ import annotations

import math

import numpy as np

from reference.kernels import kernel
from reference.params import Array, Fluid


def lattice(spacing: float, reach: float, dimensions: int = 3) -> Array:
    """Points of the cubic lattice through the origin, at least as far as `reach` on each axis.

    In a plane those of the square lattice, with z = 0.
    """
    n = math.ceil(reach / spacing)
    axis = spacing * np.arange(-n, n + 1)
    z = axis if dimensions == 3 else np.zeros(1)
    return np.stack(np.meshgrid(axis, axis, z, indexing="ij"), axis=-1).reshape(-1, 3)


def calibration(fluid: Fluid) -> tuple[float, float]:
    """V = 1 / sum W over the lattice, center included, and D_ideal = sum_k |grad_k C|^2 on it.

    grad_k C = -V grad W_ik for the neighbors k != i; grad_i C = 0, the lattice being symmetric.
    """
    W, grad_W = kernel(fluid, -lattice(fluid.spacing, fluid.h, fluid.dimensions))
    volume = 1.0 / W.sum()
    ideal_denominator = np.sum((volume * grad_W) ** 2)  # the center adds 0: grad W(0) = 0
    return float(volume), float(ideal_denominator)
