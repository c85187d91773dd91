"""The pressure method: multipliers that add up over a time step, iterated with momentum."""

from __future__ import annotations

import dataclasses
import itertools
import math

import numpy as np

from reference.boundary import centers, project, walled
from reference.calibration import calibration, lattice
from reference.coarse import coarse_correction
from reference.density import corrections, density_constraint
from reference.kernels import kernel
from reference.neighbors import Neighbors
from reference.params import Array, Box, Fluid, Solver


def largest_eigenvalue(fluid: Fluid) -> float:
    """Max over k of |V sum_r grad W(r) sin(k.r)|^2 / D_ideal, k on a grid of pi/16 per spacing."""
    r = lattice(fluid.spacing, fluid.h, fluid.dimensions)
    _, grad_W = kernel(fluid, r)
    steps = np.arange(17) * math.pi / 16.0 / fluid.spacing
    k = np.array(list(itertools.product(steps, repeat=3)))
    symbol = np.sum((np.sin(k @ r.T) @ grad_W) ** 2, axis=1)
    return float(symbol.max() / np.sum(grad_W**2))


def virial_pressures(x: Array, totals: Array, near: Neighbors, fluid: Fluid, dt: float) -> Array:
    """p_i [Pa], a third of the trace of the mean virial of the forces that multipliers stand for.

    p_i = V / (2 n) sum_k (p'_i + p'_k) (x_i - x_k).(-grad W_ik)      p' = -rho0 total / dt^2

    n dimensions, k over neighbors and boundary particles; p'_k = p'_i / 3 for the latter.
    """
    volume, _ = calibration(fluid)
    p = -fluid.rest_density * totals / dt**2
    r, r_q = near.r(x), near.r_boundary(x)
    pairs = (p[near.i] + p[near.j]) * -np.sum(r * kernel(fluid, r)[1], axis=1)
    walls = (1 + 1 / 3) * p[near.boundary_i] * -np.sum(r_q * kernel(fluid, r_q)[1], axis=1)
    return volume / (2 * fluid.dimensions) * (near.sum(pairs) + near.sum_boundary(walls))


def solve_pressures(
    x_star: Array,
    start: Array,
    near: Neighbors,
    fluid: Fluid,
    solver: Solver,
    box: Box | None,
    dt: float,
) -> tuple[Array, Array, int]:
    """Positions x*, the sum of the multipliers that led there [m^2], and the iterations.

    start    are the multipliers of the first corrections, the only ones with repulsion
    r_i      = C_i + alpha y_i                               alpha = compliance / dt^2
    D_i      = sum_k |grad_k C_i|^2 + epsilon + alpha        epsilon = relaxation D_ideal
    total_i' = min(y_i - omega r_i / D_i, -floor / D_i)      omega = 1 / largest_eigenvalue
    y_i'     = total_i' + beta (total_i' - total_i)          beta = (t - 1) / t'
    t'       = (1 + sqrt(1 + 4 t^2)) / 2, and 1 again where sum D (y - total') (total' - total) > 0

    With two levels and walls total' and y' of the first iteration have the coarse correction
    added. x* moves by the corrections of y' - y. Ends when the mean of max(r, 0) is within the
    tolerance, after at least `min_iterations`.
    """
    _, ideal_denominator = calibration(fluid)
    omega = 1.0 / largest_eigenvalue(fluid)
    alpha = solver.compliance / dt**2
    without_repulsion = dataclasses.replace(solver, tensile_strength=0.0)

    def moved(x: Array, lambdas: Array, terms: Solver) -> Array:
        dp = corrections(x, lambdas, near, fluid, terms)
        return project(x + dp, centers(fluid, box))

    x_star = moved(x_star, start, solver)
    total, y, t, iterations = start, start, 1.0, 0
    most = solver.max_iterations if solver.iterations is None else solver.iterations
    while iterations < most:
        C, grad2 = density_constraint(x_star, near, fluid)
        r = C + alpha * y
        counted = solver.iterations is not None
        met = np.mean(np.maximum(r, 0.0)) <= solver.tolerance and r.max() <= solver.max_tolerance
        if met and not counted and iterations >= solver.min_iterations:
            break
        D = grad2 + solver.relaxation * ideal_denominator + alpha
        next_total = np.minimum(y - omega * r / D, -solver.constraint_floor / D)
        next_t = (1.0 + math.sqrt(1.0 + 4.0 * t**2)) / 2.0
        beta = (t - 1.0) / next_t if solver.acceleration == "nesterov" else 0.0
        next_y = next_total + beta * (next_total - total)
        uphill = np.sum(D * (y - next_total) * (next_total - total)) > 0.0
        walls = box is not None and np.isfinite(walled(fluid, box).lower).any()
        if solver.levels > 1 and walls and iterations == 0:
            next_total = next_y = next_total + coarse_correction(
                x_star, next_total, r, near, fluid, box, alpha
            )
        x_star = moved(x_star, next_y - y, without_repulsion)
        total, y, t = next_total, next_y, 1.0 if uphill else next_t
        iterations += 1
    return x_star, y, iterations
