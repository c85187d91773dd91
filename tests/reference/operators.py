"""Differential operators over a set of particles that carry values, one formula each.

V is the volume of a particle, W and grad W those of the fluid, r_ij = x_i - x_j, and
J[a][b] = d a_a / d x_b. Differences (A_j - A_i) make each operator exact for constants.
"""

from __future__ import annotations

import numpy as np

from reference.kernels import kernel
from reference.neighbors import find_neighbors
from reference.params import Array, Fluid


def density(x: Array, fluid: Fluid, volume: float) -> Array:
    """V sum_j W_ij, j includes i: 1 at rest [-]."""
    near = find_neighbors(x, fluid)
    W, _ = kernel(fluid, x[near.i] - x[near.j])
    W_self, _ = kernel(fluid, np.zeros(3))
    return volume * (W_self + near.sum(W))


def gradient(
    values: Array, x: Array, fluid: Fluid, volume: float, corrected: bool = False
) -> Array:
    """grad A_i = V sum_j (A_j - A_i) grad W_ij; corrected: M_i^-1 times that. (n,) -> (n, 3)."""
    near = find_neighbors(x, fluid)
    _, grad_W = kernel(fluid, x[near.i] - x[near.j])
    plain = volume * near.sum((values[near.j] - values[near.i])[:, None] * grad_W)
    if not corrected:
        return plain
    # A = a.x gives V sum ((x_j - x_i).a) grad W = M^T a, so M^-T makes it a again.
    inverse = np.linalg.inv(moment(x, fluid, volume))
    return np.einsum("nba,nb->na", inverse, plain)


def jacobian(
    values: Array, x: Array, fluid: Fluid, volume: float, corrected: bool = False
) -> Array:
    """J_i = V sum_j (a_j - a_i) (x) grad W_ij; corrected: J_i M_i^-1. (n, 3) -> (n, 3, 3)."""
    near = find_neighbors(x, fluid)
    _, grad_W = kernel(fluid, x[near.i] - x[near.j])
    difference = values[near.j] - values[near.i]
    plain = volume * near.sum(difference[:, :, None] * grad_W[:, None, :])
    return plain @ np.linalg.inv(moment(x, fluid, volume)) if corrected else plain


def divergence(
    values: Array, x: Array, fluid: Fluid, volume: float, corrected: bool = False
) -> Array:
    """tr J. (n, 3) -> (n,)."""
    return np.trace(jacobian(values, x, fluid, volume, corrected), axis1=1, axis2=2)


def curl(values: Array, x: Array, fluid: Fluid, volume: float, corrected: bool = False) -> Array:
    """(J_zy - J_yz, J_xz - J_zx, J_yx - J_xy). (n, 3) -> (n, 3)."""
    J = jacobian(values, x, fluid, volume, corrected)
    return np.stack(
        [J[:, 2, 1] - J[:, 1, 2], J[:, 0, 2] - J[:, 2, 0], J[:, 1, 0] - J[:, 0, 1]], axis=1
    )


def laplacian(values: Array, x: Array, fluid: Fluid, volume: float) -> Array:
    """2 V sum_j (A_i - A_j) (r_ij . grad W_ij) / (|r_ij|^2 + 0.01 h^2) [Bro85]. (n,) -> (n,)."""
    near = find_neighbors(x, fluid)
    r = x[near.i] - x[near.j]
    _, grad_W = kernel(fluid, r)
    slope = np.sum(r * grad_W, axis=1) / (np.sum(r**2, axis=1) + 0.01 * fluid.h**2)
    return 2.0 * volume * near.sum((values[near.i] - values[near.j]) * slope)


def moment(x: Array, fluid: Fluid, volume: float) -> Array:
    """M_i = V sum_j (x_j - x_i) (x) grad W_ij, the Jacobian of the positions: I in the ideal."""
    return jacobian(x, x, fluid, volume)
