"""Particle sets that the tests share."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from reference.params import Array


def lattice_block(n: int | tuple[int, int, int], d: float) -> Array:
    """Centers of n cells of size d per axis, in a block with its lower corner at the origin."""
    counts = (n, n, n) if isinstance(n, int) else n
    axes = [d * (np.arange(count) + 0.5) for count in counts]
    return np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1).reshape(-1, 3)


def jittered_block(n: int | tuple[int, int, int], d: float, seed: int, share: float = 0.2) -> Array:
    """The same block, every coordinate moved by up to `share` of d."""
    x = lattice_block(n, d)
    return x + share * d * np.random.default_rng(seed).uniform(-1, 1, x.shape)


def bulk(x: Array, d: float, reach: float) -> NDArray[np.bool_]:
    """Which particles are farther than `reach` from the faces of the block of cells."""
    lower, upper = x.min(0) - d / 2, x.max(0) + d / 2
    return np.asarray(np.all((x > lower + reach) & (x < upper - reach), axis=1))
