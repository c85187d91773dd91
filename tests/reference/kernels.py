"""Smoothing kernels with support radius h: W(r) and grad W(r) with respect to r.

r is the vector x_i - x_j, shape (..., 3). Each kernel is 0 from h on. The gradient at r = 0 is the
zero vector: the value that symmetry demands, and the only finite choice for the spiky kernel.

In space W is in 1/m^3 and grad W in 1/m^4. In a plane (dimensions = 2) they are in 1/m^2 and 1/m^3:
the same functions of r/h with other constants in front, so that W integrates to 1 over the plane.
"""

from __future__ import annotations

import numpy as np

from reference.params import Array, Fluid


def poly6(r: Array, h: float, dimensions: int = 3) -> Array:
    """W = 315 / (64 pi h^9) (h^2 - r^2)^3 [MCG03]; in a plane 4 / (pi h^8) (h^2 - r^2)^3."""
    distance = np.linalg.norm(r, axis=-1)
    constant = {3: 315.0 / (64.0 * np.pi * h**9), 2: 4.0 / (np.pi * h**8)}[dimensions]
    return np.where(distance < h, constant * (h**2 - distance**2) ** 3, 0.0)


def spiky_gradient(r: Array, h: float, dimensions: int = 3) -> Array:
    """grad W = -45 / (pi h^6) (h - r)^2 r/|r|, of W = 15 / (pi h^6) (h - r)^3 [MCG03].

    In a plane -30 / (pi h^5) (h - r)^2 r/|r|, of W = 10 / (pi h^5) (h - r)^3.
    """
    distance = np.linalg.norm(r, axis=-1)
    constant = {3: 45.0 / (np.pi * h**6), 2: 30.0 / (np.pi * h**5)}[dimensions]
    return _along(r, distance, np.where(distance < h, -constant * (h - distance) ** 2, 0.0))


def cubic_spline(r: Array, h: float, dimensions: int = 3) -> Array:
    """W = 8 / (pi h^3) { 6 (q^3 - q^2) + 1 for q <= 1/2, 2 (1 - q)^3 for q <= 1 }, q = r/h [Mon92].

    Monaghan's spline has its support at twice the smoothing length; here h is the support radius.
    In a plane the constant is 40 / (7 pi h^2).
    """
    q = np.linalg.norm(r, axis=-1) / h
    value = np.where(q <= 0.5, 6.0 * (q**3 - q**2) + 1.0, 2.0 * (1.0 - q) ** 3)
    return _spline_constant(h, dimensions) * np.where(q < 1.0, value, 0.0)


def cubic_spline_gradient(r: Array, h: float, dimensions: int = 3) -> Array:
    """dW/dr = 48 / (pi h^4) { q (3 q - 2) for q <= 1/2, -(1 - q)^2 for q <= 1 }, along r/|r|.

    In a plane the constant is 240 / (7 pi h^3).
    """
    distance = np.linalg.norm(r, axis=-1)
    q = distance / h
    derivative = np.where(q <= 0.5, q * (3.0 * q - 2.0), -((1.0 - q) ** 2))
    derivative = 6.0 / h * _spline_constant(h, dimensions) * np.where(q < 1.0, derivative, 0.0)
    return _along(r, distance, derivative)


def wendland(r: Array, h: float, dimensions: int = 3) -> Array:
    """W = 21 / (2 pi h^3) (1 - q)^4 (1 + 4 q), q = r/h [Wen95]; 7 / (pi h^2) in a plane."""
    scale = 21.0 / (2.0 * np.pi * h**3) if dimensions == 3 else 7.0 / (np.pi * h**2)
    q = np.linalg.norm(r, axis=-1) / h
    return scale * np.where(q < 1.0, (1.0 - q) ** 4 * (1.0 + 4.0 * q), 0.0)


def wendland_gradient(r: Array, h: float, dimensions: int = 3) -> Array:
    """dW/dr = -210 / (pi h^4) q (1 - q)^3, along r/|r|; -140 / (pi h^3) in a plane."""
    scale = 210.0 / (np.pi * h**4) if dimensions == 3 else 140.0 / (np.pi * h**3)
    distance = np.linalg.norm(r, axis=-1)
    q = distance / h
    return _along(r, distance, -scale * np.where(q < 1.0, q * (1.0 - q) ** 3, 0.0))


def kernel(fluid: Fluid, r: Array) -> tuple[Array, Array]:
    """(W, grad W) that the fluid uses: W for densities, grad W for gradients."""
    r = np.asarray(r, dtype=np.float64)
    shape = fluid.h, fluid.dimensions
    if fluid.kernel == "poly6_spiky":
        return poly6(r, *shape), spiky_gradient(r, *shape)
    if fluid.kernel == "cubic_spline":
        return cubic_spline(r, *shape), cubic_spline_gradient(r, *shape)
    if fluid.kernel == "wendland":
        return wendland(r, *shape), wendland_gradient(r, *shape)
    raise ValueError(f"unknown kernel {fluid.kernel!r}")


def _spline_constant(h: float, dimensions: int) -> float:
    return {3: 8.0 / (np.pi * h**3), 2: 40.0 / (7.0 * np.pi * h**2)}[dimensions]


def _along(r: Array, distance: Array, derivative: Array) -> Array:
    """derivative * r/|r|, the zero vector at r = 0."""
    apart = distance > 0.0
    unit = r / np.where(apart, distance, 1.0)[..., None]
    return np.where(apart, derivative, 0.0)[..., None] * unit
