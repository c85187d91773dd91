"""One time step of Position Based Fluids, Algorithm 1 of [MM13], a function per stage."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from reference.boundary import centers, project, wrap
from reference.calibration import calibration
from reference.density import corrections, density_constraint, multipliers
from reference.kernels import kernel
from reference.neighbors import Neighbors, find_neighbors
from reference.params import Array, Box, Fluid, Solver
from reference.pressure import solve_pressures

MOST_WARM_PUSH = 0.5  # largest |total| that a step starts from, in squared spacings


@dataclass(frozen=True)
class State:
    """Positions [m] and velocities [m/s], with the densities and multipliers last seen.

    totals: each particle's multipliers added up over the last step, `dt` long [m^2], [s].
    """

    x: Array
    v: Array
    densities: Array
    multipliers: Array
    totals: Array
    dt: float = 0.0
    iterations: int = 0

    @classmethod
    def at(cls, x: Array, v: Array) -> State:
        """Particles that have not taken a step yet."""
        x, v = np.asarray(x, dtype=np.float64), np.asarray(v, dtype=np.float64)
        return cls(x, v, np.zeros(len(x)), np.zeros(len(x)), np.zeros(len(x)))


def predict(x: Array, v: Array, fluid: Fluid, box: Box | None, dt: float) -> tuple[Array, Array]:
    """v <- v + dt g;  x* <- project(x + dt v)."""
    v = v + dt * np.asarray(fluid.gravity)
    return v, project(x + dt * v, centers(fluid, box))


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
    if solver.method_in_force == "plain":
        lambdas, totals = np.zeros(len(state.x)), np.zeros(len(state.x))
        iterations = 4 if solver.iterations is None else solver.iterations
        for _ in range(iterations):
            densities, lambdas = multipliers(x_star, near, fluid, solver)
            dp = corrections(x_star, lambdas, near, fluid, solver)
            x_star = project(x_star + dp, centers(fluid, box))
            totals = totals + lambdas
    else:
        # The last step's pressures for this step's length, but for particles that had come free.
        share = solver.warm_start * (dt / state.dt) ** 2 if state.dt > 0.0 else 0.0
        pressed = state.densities >= 0.9 * fluid.rest_density
        start = np.where(pressed, share * state.totals, 0.0)
        start *= min(1.0, MOST_WARM_PUSH * fluid.spacing**2 / max(np.abs(start).max(), 1e-300))
        x_star, totals, iterations = solve_pressures(x_star, start, near, fluid, solver, box, dt)
        lambdas = totals
        C, _ = density_constraint(x_star, near, fluid)
        densities = fluid.rest_density * (C + 1.0)
    v = (x_star - state.x) / dt
    if solver.vorticity > 0.0:
        omega = vorticity(x_star, v, near, fluid)
        v = confine(x_star, v, omega, near, fluid, strength=solver.vorticity, dt=dt)
    if solver.xsph > 0.0:
        v = xsph(x_star, v, near, fluid, solver.xsph)
    return State(wrap(x_star, box), v, densities, lambdas, totals, dt, iterations)
