"""Pairs within the support radius, by brute force."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from reference.boundary import boundary_lattice
from reference.params import Array, Box, Fluid

Indices = NDArray[np.int64]


def pairs_within(a: Array, b: Array, h: float) -> tuple[Indices, Indices]:
    """All (i, j) with |a_i - b_j|^2 < h^2, sorted by i, then by j."""
    rows, columns = [np.empty(0, np.int64)], [np.empty(0, np.int64)]
    for i, point in enumerate(a):  # row by row: n^2 work without n^2 memory
        j = np.flatnonzero(np.sum((point - b) ** 2, axis=1) < h**2)
        rows.append(np.full(len(j), i))
        columns.append(j)
    return np.concatenate(rows), np.concatenate(columns)


@dataclass(frozen=True)
class Neighbors:
    """Who is near whom, found once per time step: fluid pairs i != j, and boundary pairs (i, k)."""

    count: int
    i: Indices
    j: Indices
    boundary_i: Indices
    boundary_k: Indices
    q: Array

    def sum(self, terms: Array) -> Array:
        """Row i holds the sum of the terms of particle i over its fluid neighbors j."""
        return _sum_by(self.i, terms, self.count)

    def sum_boundary(self, terms: Array) -> Array:
        """Row i holds the sum of the terms of particle i over its boundary particles k."""
        return _sum_by(self.boundary_i, terms, self.count)


def find_neighbors(x_star: Array, fluid: Fluid, box: Box | None = None) -> Neighbors:
    """Fluid and boundary neighbors of x*, those with r^2 < h^2. Nobody neighbors itself."""
    i, j = pairs_within(x_star, x_star, fluid.h)
    others = i != j
    q = np.empty((0, 3))
    if box is not None and len(x_star) > 0:
        q = boundary_lattice(fluid, box, plane=x_star[0, 2])
    boundary_i, boundary_k = pairs_within(x_star, q, fluid.h)
    return Neighbors(len(x_star), i[others], j[others], boundary_i, boundary_k, q)


def _sum_by(i: Indices, terms: Array, count: int) -> Array:
    columns = terms.reshape(len(i), math.prod(terms.shape[1:])).T
    sums = [np.bincount(i, weights=column, minlength=count) for column in columns]
    return np.stack(sums, axis=1).reshape(count, *terms.shape[1:])
