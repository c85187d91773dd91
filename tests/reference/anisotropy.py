"""Sprites as ellipsoids, after Yu and Turk, and what a camera sees of them; plain and slow.

[YT13] J. Yu, G. Turk. Reconstructing Surfaces of Particle-Based Fluids Using Anisotropic Kernels.
       ACM TOG 32(1), 2013.
"""

from __future__ import annotations

import numpy as np

from reference.params import Array

MOST_RATIO = 4.0  # of semi-axes
FEWEST = 6.0  # sum of weights from which a group is fully stretched
CENTER_SHARE = 0.3  # of the way to the neighbors' mean


def ellipsoids(x: Array, s: float, anisotropy: float) -> tuple[Array, Array]:
    """Centers, and the stretches that make ellipsoids of spheres."""
    centers, stretches = [], []
    for center in x:
        r = x - center
        q = np.linalg.norm(r, axis=1) / s
        w = np.maximum(1 - q**3, 0)
        mean = w @ r / w.sum()
        covariance = (w[:, None] * (r - mean)).T @ (r - mean) / w.sum()
        share = anisotropy * min(1.0, (w.sum() - 1) / FEWEST)
        c, axes = np.linalg.eigh(covariance)
        c = np.maximum(c, c[2] / MOST_RATIO) if c[2] > 0 else np.ones(3)
        centers.append(center + CENTER_SHARE * share * mean)
        stretches.append(axes @ np.diag((c / np.cbrt(c.prod())) ** share) @ axes.T)
    return np.array(centers), np.array(stretches)


def first_hits(
    origins: Array, directions: Array, centers: Array, stretches: Array, radius: float
) -> tuple[Array, Array, Array]:
    """Where rays o + t v enter the first of the ellipsoids, and their way through all of them.

    Beside t, 0 where there is none, and the length: how near a ray comes to touching one, as a
    share of the radius squared, where t may jump.
    """
    first = np.full(len(origins), np.inf)
    length = np.zeros(len(origins))
    margin = np.full(len(origins), np.inf)
    for center, stretch in zip(centers, stretches, strict=True):
        to_sphere = np.linalg.inv(stretch) / radius
        v = directions @ to_sphere
        o = (center - origins) @ to_sphere
        v2, vo = (v * v).sum(axis=1), (v * o).sum(axis=1)
        discriminant = vo**2 - v2 * ((o * o).sum(axis=1) - 1)
        margin = np.minimum(margin, np.abs(discriminant / v2))
        half = np.sqrt(np.maximum(discriminant, 0)) / v2
        first = np.where(discriminant > 0, np.minimum(first, vo / v2 - half), first)
        length += 2 * half * np.linalg.norm(directions, axis=1)
    return np.where(np.isinf(first), 0, first), length, margin
