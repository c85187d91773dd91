"""One time step of Position Based Fluids, Algorithm 1 of [MM13], a function per stage."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from reference.boundary import centers, project, wrap
from reference.calibration import calibration
from reference.kernels import kernel
from reference.neighbors import Neighbors, find_neighbors
from reference.params import Array, Box, Fluid, Solver


@dataclass(frozen=True)
class State:
    """Positions [m] and velocities [m/s], with the densities and multipliers last seen."""

    x: Array
    v: Array
    densities: Array
    multipliers: Array

    @classmethod
    def at(cls, x: Array, v: Array) -> State:
        """Particles that have not taken a step yet."""
        x, v = np.asarray(x, dtype=np.float64), np.asarray(v, dtype=np.float64)
        return cls(x, v, np.zeros(len(x)), np.zeros(len(x)))


def predict(x: Array, v: Array, fluid: Fluid, box: Box | None, dt: float) -> tuple[Array, Array]:
    """v <- v + dt g;  x* <- project(x + dt v)."""
    v = v + dt * np.asarray(fluid.gravity)
    return v, project(x + dt * v, centers(fluid, box))


def multipliers(
    x_star: Array, near: Neighbors, fluid: Fluid, solver: Solver
) -> tuple[Array, Array]:
    """Densities rho_i [kg/m^3] and multipliers lambda_i [m^2].

    C_i      = V sum_j W(x*_i - x*_j) + V sum_k W(x*_i - q_k) - 1     j includes i
    grad_i C = V sum_{j != i} grad W_ij + V sum_k grad W_ik           grad_j C = -V grad W_ij
    lambda_i = -max(C_i, floor) / (sum_k |grad_k C_i|^2 + epsilon)    epsilon = relaxation D_ideal

    The boundary particles do not move, so they enter grad_i C but have no gradient of their own.
    Where nothing has a gradient and epsilon is 0, no correction could change C: lambda is 0 there.
    """
    volume, ideal_denominator = calibration(fluid)
    W_self, _ = kernel(fluid, np.zeros(3))
    W, grad_W, W_q, grad_W_q = _pair_kernels(x_star, near, fluid)

    C = volume * (W_self + near.sum(W) + near.sum_boundary(W_q)) - 1.0
    grad_i = volume * (near.sum(grad_W) + near.sum_boundary(grad_W_q))
    grad_j = -volume * grad_W
    denominator = np.sum(grad_i**2, axis=1) + near.sum(np.sum(grad_j**2, axis=1))

    denominator = denominator + solver.relaxation * ideal_denominator

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


def vorticity(x: Array, v: Array, near: Neighbors, fluid: Fluid) -> Array:
    """omega_i = V sum_j (v_j - v_i) x grad_j W(x_i - x_j)  [1/s], with grad_j W = -grad W_ij."""
    volume, _ = calibration(fluid)
    _, grad_W = kernel(fluid, near.r(x))
    return volume * near.sum(np.cross(v[near.j] - v[near.i], -grad_W))


def confine(
    x: Array,
    v: Array,
    omega: Array,
    near: Neighbors,
    fluid: Fluid,
    *,
    strength: float,
    dt: float,
) -> Array:
    """v_i <- v_i + dt strength (N x omega_i),  N = eta/|eta|,  eta_i = V sum_j |omega_j| grad W_ij.

    N is 0 where eta is no more than rounding: |eta| h <= 1e-4 |omega_i|.
    """
    volume, _ = calibration(fluid)
    _, grad_W = kernel(fluid, near.r(x))
    size = np.linalg.norm(omega, axis=1)
    eta = volume * near.sum(size[near.j, None] * grad_W)
    eta_size = np.linalg.norm(eta, axis=1)
    told = eta_size * fluid.h > 1e-4 * size
    N = np.where(told[:, None], eta / np.where(told, eta_size, 1.0)[:, None], 0.0)
    return v + dt * strength * np.cross(N, omega)


def xsph(x: Array, v: Array, near: Neighbors, fluid: Fluid, strength: float) -> Array:
    """v_i <- v_i + strength V sum_j (v_j - v_i) W_ij, every v on the right the old one."""
    volume, _ = calibration(fluid)
    W, _ = kernel(fluid, near.r(x))
    return v + strength * volume * near.sum((v[near.j] - v[near.i]) * W[:, None])


def step(state: State, fluid: Fluid, solver: Solver, box: Box | None, dt: float) -> State:
    """One time step: predict, neighbors once, iterate, velocity, vorticity, XSPH, commit.

    Along periodic axes neighbors are images, so x* may leave the box until the step has ended.
    """
    v, x_star = predict(state.x, state.v, fluid, box, dt)
    near = find_neighbors(x_star, fluid, box)
    for _ in range(solver.iterations):
        densities, lambdas = multipliers(x_star, near, fluid, solver)
        dp = corrections(x_star, lambdas, near, fluid, solver)
        x_star = project(x_star + dp, centers(fluid, box))
    v = (x_star - state.x) / dt
    if solver.vorticity > 0.0:
        omega = vorticity(x_star, v, near, fluid)
        v = confine(x_star, v, omega, near, fluid, strength=solver.vorticity, dt=dt)
    if solver.xsph > 0.0:
        v = xsph(x_star, v, near, fluid, solver.xsph)
    return State(wrap(x_star, box), v, densities, lambdas)


def _pair_kernels(
    x_star: Array, near: Neighbors, fluid: Fluid
) -> tuple[Array, Array, Array, Array]:
    """W_ij, grad W_ij over the fluid pairs, and W_ik, grad W_ik over the boundary pairs."""
    W, grad_W = kernel(fluid, near.r(x_star))
    W_q, grad_W_q = kernel(fluid, near.r_boundary(x_star))
    return W, grad_W, W_q, grad_W_q
