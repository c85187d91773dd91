"""Walls: the lattice of fixed particles outside a box, and the projection back into it."""

from __future__ import annotations

import itertools
import math

import numpy as np

from reference.params import Array, Box, Fluid


def boundary_lattice(fluid: Fluid, box: Box, plane: float = 0.0) -> Array:
    """Boundary particles q of the box [m]: the product of three axes, less the points inside.

    Per axis, with d the spacing: K = ceil(h/d) layers below the wall, the first d/2 outside it; as
    many above; between the walls n = max(1, round(L/d)) cells of size L/n, a point at each center.
    The layers outside thus stand opposite the fluid's, whatever the length of the box.
    In 2-D there is one point along z: that of the plane [m], between the walls there are not.
    """
    d = fluid.spacing
    layers = math.ceil(fluid.h / d)
    outside = d * (np.arange(layers) + 0.5)
    axes, walled = [], []
    for lower, upper in zip(box.lower, box.upper, strict=True):
        n = max(1, math.floor((upper - lower) / d + 0.5))
        inside = lower + (upper - lower) / n * (np.arange(n) + 0.5)
        axes.append(np.concatenate([lower - outside[::-1], inside, upper + outside]))
        walled.append(True)
    if fluid.dimensions == 2:
        axes[2], walled[2] = np.array([plane]), False
    points = np.array(list(itertools.product(*axes)))
    beyond = (points < box.lower) | (points > box.upper)
    return points[np.any(beyond & walled, axis=1)]


def project(x: Array, box: Box | None) -> Array:
    """The point of the closed box nearest to x: collision detection and response in one."""
    return x.copy() if box is None else np.clip(x, box.lower, box.upper)


def centers(fluid: Fluid, box: Box | None) -> Box | None:
    """Where particle centers may be: the box less the particle's radius d/2 from every wall."""
    if box is None:
        return None
    radius = fluid.spacing / 2.0
    lower, upper = np.asarray(box.lower) + radius, np.asarray(box.upper) - radius
    lower[fluid.dimensions :], upper[fluid.dimensions :] = -np.inf, np.inf
    return Box(lower, upper)
