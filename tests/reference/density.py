"""The density constraint: its value and gradients, and the corrections of given multipliers."""

from __future__ import annotations

import numpy as np

from reference.calibration import calibration
from reference.kernels import kernel
from reference.neighbors import Neighbors
from reference.params import Array, Fluid, Solver


def density_constraint(x_star: Array, near: Neighbors, fluid: Fluid) -> tuple[Array, Array]:
    """C_i [-] and sum_k |grad_k C_i|^2 [1/m^2].

    C_i      = V sum_j W(x*_i - x*_j) + V sum_k W(x*_i - q_k) - 1     j includes i
    grad_i C = V sum_{j != i} grad W_ij + V sum_k grad W_ik           grad_j C = -V grad W_ij

    The boundary particles do not move, so they enter grad_i C but have no gradient of their own.
    """
    volume, _ = calibration(fluid)
    W_self, _ = kernel(fluid, np.zeros(3))
    W, grad_W, W_q, grad_W_q = _pair_kernels(x_star, near, fluid)
    C = volume * (W_self + near.sum(W) + near.sum_boundary(W_q)) - 1.0
    grad_i = volume * (near.sum(grad_W) + near.sum_boundary(grad_W_q))
    grad_j = -volume * grad_W
    return C, np.sum(grad_i**2, axis=1) + near.sum(np.sum(grad_j**2, axis=1))


def multipliers(
    x_star: Array, near: Neighbors, fluid: Fluid, solver: Solver
) -> tuple[Array, Array]:
    """Densities rho_i [kg/m^3] and multipliers lambda_i [m^2].

    lambda_i = -max(C_i, floor) / (sum_k |grad_k C_i|^2 + epsilon)    epsilon = relaxation D_ideal

    Where nothing has a gradient and epsilon is 0, no correction could change C: lambda is 0 there.
    """
    _, ideal_denominator = calibration(fluid)
    C, grad2 = density_constraint(x_star, near, fluid)
    denominator = grad2 + solver.relaxation * ideal_denominator

    clamped = np.maximum(C, solver.constraint_floor)
    movable = denominator > 0.0
    lambdas = np.where(movable, -clamped / np.where(movable, denominator, 1.0), 0.0)
    return fluid.rest_density * (C + 1.0), lambdas


def corrections(
    x_star: Array, lambdas: Array, near: Neighbors, fluid: Fluid, solver: Solver
) -> Array:
    """Delta p_i [m].

    Delta p_i = V sum_{j != i} (lambda_i + lambda_j + s_ij) grad W_ij
              + V sum_k (lambda_i + s_ik) grad W_ik
    s_ij      = -k (W(r_ij) / W(Delta q))^n         k = tensile_strength / D_ideal
    """
    volume, ideal_denominator = calibration(fluid)
    W, grad_W, W_q, grad_W_q = _pair_kernels(x_star, near, fluid)
    W_dq, _ = kernel(fluid, np.array([solver.tensile_distance * fluid.h, 0.0, 0.0]))

    k = solver.tensile_strength / ideal_denominator
    s = -k * (W / W_dq) ** solver.tensile_exponent
    s_q = -k * (W_q / W_dq) ** solver.tensile_exponent

    pairs = (lambdas[near.i] + lambdas[near.j] + s)[:, None] * grad_W
    walls = (lambdas[near.boundary_i] + s_q)[:, None] * grad_W_q
    return volume * (near.sum(pairs) + near.sum_boundary(walls))


def _pair_kernels(
    x_star: Array, near: Neighbors, fluid: Fluid
) -> tuple[Array, Array, Array, Array]:
    """W_ij, grad W_ij over the fluid pairs, and W_ik, grad W_ik over the boundary pairs."""
    W, grad_W = kernel(fluid, near.r(x_star))
    W_q, grad_W_q = kernel(fluid, near.r_boundary(x_star))
    return W, grad_W, W_q, grad_W_q
