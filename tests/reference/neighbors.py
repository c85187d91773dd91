"""Pairs within the support radius, by brute force."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from reference.boundary import boundary_lattice, nearest_image
from reference.params import Array, Box, Fluid

Indices = NDArray[np.int64]


def pairs_within(a: Array, b: Array, h: float, box: Box | None = None) -> tuple[Indices, Indices]:
    """All (i, j) with |a_i - b_j|^2 < h^2, to the nearest image, sorted by i, then by j."""
    rows, columns = [np.empty(0, np.int64)], [np.empty(0, np.int64)]
    for i, point in enumerate(a):  # row by row: n^2 work without n^2 memory
        j = np.flatnonzero(np.sum(nearest_image(point - b, box) ** 2, axis=1) < h**2)
        rows.append(np.full(len(j), i))
        columns.append(j)
    return np.concatenate(rows), np.concatenate(columns)


@dataclass(frozen=True)
class Neighbors:
    """Who is near whom, found once per time step: fluid pairs i != j, and boundary pairs (i, k).

    The shift of a pair is what separates j, or k, from its image near i: 0 without periodic axes.
    """

    count: int
    i: Indices
    j: Indices
    boundary_i: Indices
    boundary_k: Indices
    q: Array
    shift: Array
    boundary_shift: Array

    def r(self, x: Array) -> Array:
        """r_ij = x_i - x_j of the fluid pairs, from the image of j near i."""
        return x[self.i] - x[self.j] - self.shift

    def r_boundary(self, x: Array) -> Array:
        """r_ik = x_i - q_k of the boundary pairs, from the image of k near i."""
        return x[self.boundary_i] - self.q[self.boundary_k] - self.boundary_shift

    def sum(self, terms: Array) -> Array:
        """Row i holds the sum of the terms of particle i over its fluid neighbors j."""
        return _sum_by(self.i, terms, self.count)

    def sum_boundary(self, terms: Array) -> Array:
        """Row i holds the sum of the terms of particle i over its boundary particles k."""
        return _sum_by(self.boundary_i, terms, self.count)


def find_neighbors(x_star: Array, fluid: Fluid, box: Box | None = None) -> Neighbors:
    """Fluid and boundary neighbors of x*, those with r^2 < h^2. Nobody neighbors itself."""
    i, j = pairs_within(x_star, x_star, fluid.h, box)
    others = i != j
    i, j = i[others], j[others]
    q = np.empty((0, 3))
    if box is not None and len(x_star) > 0:
        q = boundary_lattice(fluid, box, plane=x_star[0, 2])
    boundary_i, boundary_k = pairs_within(x_star, q, fluid.h, box)
    r, r_boundary = x_star[i] - x_star[j], x_star[boundary_i] - q[boundary_k]
    shift = r - nearest_image(r, box)
    boundary_shift = r_boundary - nearest_image(r_boundary, box)
    return Neighbors(len(x_star), i, j, boundary_i, boundary_k, q, shift, boundary_shift)


def _sum_by(i: Indices, terms: Array, count: int) -> Array:
    columns = terms.reshape(len(i), math.prod(terms.shape[1:])).T
    sums = [np.bincount(i, weights=column, minlength=count) for column in columns]
    return np.stack(sums, axis=1).reshape(count, *terms.shape[1:])
