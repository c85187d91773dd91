"""The coarse level of the pressure method: a correction from a grid of wide cells."""

from __future__ import annotations

import itertools

import numpy as np

from reference.boundary import centers
from reference.calibration import calibration
from reference.kernels import kernel
from reference.neighbors import Neighbors
from reference.params import Array, Box, Fluid

WIDTH = 6.0  # of a cell, in spacings
ENOUGH = 0.1  # residual of the conjugate gradients, as a share of the first
MOST_PUSH = 1.0  # largest multiplier before and largest added, in squared spacings


def hats(x: Array, fluid: Fluid, box: Box | None) -> tuple[Array, Array]:
    """Trilinear functions of all corners that particles are near: w (n, m) and grad w (n, m, 3)."""
    n, corners = len(x), np.zeros((len(x), 8, 3), int)
    w, grad_w = np.ones((n, 8)), np.ones((n, 8, 3))
    choices = np.array(list(itertools.product((0, 1), repeat=3)))
    for axis in range(3):
        lower, width, period = 0.0, WIDTH * fluid.spacing, 0
        if box is not None:
            lower = box.lower[axis]
            if box.periodic[axis]:
                length = box.upper[axis] - lower
                period = max(int(length // width), 1)
                width = length / period
        s = (x[:, axis] - lower) / width
        if fluid.dimensions == 2 and axis == 2:
            s = np.zeros(n)
        cell = np.floor(s).astype(int)
        upper = choices[:, axis] == 1
        f = (s - cell)[:, None]
        here, slope = np.where(upper, f, 1 - f), np.where(upper, 1.0, -1.0) / width
        w *= here
        for k in range(3):
            grad_w[:, :, k] *= slope if k == axis else here
        at = cell[:, None] + choices[:, axis]
        corners[:, :, axis] = at % period if period else at
    _, places = np.unique(corners.reshape(-1, 3), axis=0, return_inverse=True)
    places = places.reshape(n, 8)
    all_w, all_grad = np.zeros((n, places.max() + 1)), np.zeros((n, places.max() + 1, 3))
    rows = np.arange(n)[:, None]
    np.add.at(all_w, (rows, places), w)
    np.add.at(all_grad, (rows, places), grad_w)
    return all_w, all_grad


def coarse_correction(
    x: Array,
    total: Array,
    r: Array,
    near: Neighbors,
    fluid: Fluid,
    box: Box | None,
    alpha: float,
) -> Array:
    """What is added to the multipliers `total` [m^2], from the residuals r [-] at x.

    a_i  = 1 where total_i < 0, else 0
    g_i  = V sum_j (a_i + a_j) grad W_ij + V sum_k a_i grad W_ik
    B_i  = V sum_j a_j grad W_ij (x_j - x_i)^T
    G_ic = w_c(x_i) g_i + B_i grad w_c(x_i), 0 along axes where a wall holds i
    sum_c' sum_i (G_ic . G_ic' + alpha a_i w_c w_c') mu_c' = -sum_i a_i w_c r_i
    """
    volume, _ = calibration(fluid)
    a = np.where(total < 0.0, 1.0, 0.0)
    apart, apart_q = near.r(x), near.r_boundary(x)
    grad_W, grad_W_q = kernel(fluid, apart)[1], kernel(fluid, apart_q)[1]
    walls = a[near.boundary_i, None] * grad_W_q
    pairs = (a[near.i] + a[near.j])[:, None] * grad_W
    g = volume * (near.sum(pairs) + near.sum_boundary(walls))
    B = volume * near.sum(a[near.j, None, None] * grad_W[:, :, None] * -apart[:, None, :])
    w, grad_w = hats(x, fluid, box)
    G = w[:, :, None] * g[:, None, :] + np.einsum("ikm,icm->ick", B, grad_w)
    inside = centers(fluid, box)
    if inside is not None:
        held = (x <= np.asarray(inside.lower)) | (x >= np.asarray(inside.upper))
        G = np.where(held[:, None, :], 0.0, G)
    A = np.einsum("ick,iek->ce", G, G) + alpha * np.einsum("i,ic,ie->ce", a, w, w)
    delta = a * (w @ conjugate_gradients(A, -w.T @ (a * r)))
    most = max(MOST_PUSH * fluid.spacing**2 - np.abs(total).max(), 0.0)
    delta *= min(1.0, most / max(np.abs(delta).max(), 1e-300))
    return np.minimum(total + delta, 0.0) - total


def conjugate_gradients(A: Array, b: Array) -> Array:
    """x with A x = b, roughly; preconditioned by the diagonal, 0 where that is 0."""
    diagonal = np.diag(A)
    inverse = np.where(diagonal > 0.0, 1.0 / np.where(diagonal > 0.0, diagonal, 1.0), 0.0)
    x, r = np.zeros_like(b), b
    p = inverse * r
    rz = first = r @ p
    while rz > ENOUGH**2 * first:
        Ap = A @ p
        x, r = x + rz / (p @ Ap) * p, r - rz / (p @ Ap) * Ap
        rz, last = r @ (inverse * r), rz
        p = inverse * r + rz / last * p
    return x
