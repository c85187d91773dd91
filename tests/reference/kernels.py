"""Smoothing kernels with support radius h: W(r) [1/m^3] and grad W(r) with respect to r [1/m^4].

r is the vector x_i - x_j, shape (..., 3). Each kernel is 0 from h on. The gradient at r = 0 is the
zero vector: the value that symmetry demands, and the only finite choice for the spiky kernel.
"""

from __future__ import annotations

import numpy as np

from reference.params import Array, Fluid


def poly6(r: Array, h: float) -> Array:
    """W = 315 / (64 pi h^9) (h^2 - r^2)^3 [MCG03]."""
    distance = np.linalg.norm(r, axis=-1)
    value = 315.0 / (64.0 * np.pi * h**9) * (h**2 - distance**2) ** 3
    return np.where(distance < h, value, 0.0)


def spiky_gradient(r: Array, h: float) -> Array:
    """grad W = -45 / (pi h^6) (h - r)^2 r/|r|, of W = 15 / (pi h^6) (h - r)^3 [MCG03]."""
    distance = np.linalg.norm(r, axis=-1)
    derivative = -45.0 / (np.pi * h**6) * (h - distance) ** 2
    return _along(r, distance, np.where(distance < h, derivative, 0.0))


def cubic_spline(r: Array, h: float) -> Array:
    """W = 8 / (pi h^3) { 6 (q^3 - q^2) + 1 for q <= 1/2, 2 (1 - q)^3 for q <= 1 }, q = r/h [Mon92].

    Monaghan's spline has its support at twice the smoothing length; here h is the support radius.
    """
    q = np.linalg.norm(r, axis=-1) / h
    value = np.where(q <= 0.5, 6.0 * (q**3 - q**2) + 1.0, 2.0 * (1.0 - q) ** 3)
    return 8.0 / (np.pi * h**3) * np.where(q < 1.0, value, 0.0)


def cubic_spline_gradient(r: Array, h: float) -> Array:
    """dW/dr = 48 / (pi h^4) { q (3 q - 2) for q <= 1/2, -(1 - q)^2 for q <= 1 }, along r/|r|."""
    distance = np.linalg.norm(r, axis=-1)
    q = distance / h
    derivative = np.where(q <= 0.5, q * (3.0 * q - 2.0), -((1.0 - q) ** 2))
    derivative = 48.0 / (np.pi * h**4) * np.where(q < 1.0, derivative, 0.0)
    return _along(r, distance, derivative)


def wendland(r: Array, h: float) -> Array:
    """W = 21 / (2 pi h^3) (1 - q)^4 (1 + 4 q), q = r/h [Wen95]."""
    q = np.linalg.norm(r, axis=-1) / h
    return 21.0 / (2.0 * np.pi * h**3) * np.where(q < 1.0, (1.0 - q) ** 4 * (1.0 + 4.0 * q), 0.0)


def wendland_gradient(r: Array, h: float) -> Array:
    """dW/dr = -210 / (pi h^4) q (1 - q)^3, along r/|r|."""
    distance = np.linalg.norm(r, axis=-1)
    q = distance / h
    derivative = -210.0 / (np.pi * h**4) * np.where(q < 1.0, q * (1.0 - q) ** 3, 0.0)
    return _along(r, distance, derivative)


def kernel(fluid: Fluid, r: Array) -> tuple[Array, Array]:
    """(W, grad W) that the fluid uses: W for densities, grad W for gradients."""
    r = np.asarray(r, dtype=np.float64)
    if fluid.kernel == "poly6_spiky":
        return poly6(r, fluid.h), spiky_gradient(r, fluid.h)
    if fluid.kernel == "cubic_spline":
        return cubic_spline(r, fluid.h), cubic_spline_gradient(r, fluid.h)
    if fluid.kernel == "wendland":
        return wendland(r, fluid.h), wendland_gradient(r, fluid.h)
    raise ValueError(f"unknown kernel {fluid.kernel!r}")


def _along(r: Array, distance: Array, derivative: Array) -> Array:
    """derivative * r/|r|, the zero vector at r = 0."""
    apart = distance > 0.0
    unit = r / np.where(apart, distance, 1.0)[..., None]
    return np.where(apart, derivative, 0.0)[..., None] * unit
