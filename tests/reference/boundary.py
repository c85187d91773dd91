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
    A periodic axis has the cells only, which stand for their images beyond its faces as well. In
    2-D there is one point along z, that of the plane [m]. Neither counts as outside.
    """
    d = fluid.spacing
    layers = math.ceil(fluid.h / d)
    outside = d * (np.arange(layers) + 0.5)
    axes = []
    for lower, upper, periodic in zip(box.lower, box.upper, box.periodic, strict=True):
        n = max(1, math.floor((upper - lower) / d + 0.5))
        inside = lower + (upper - lower) / n * (np.arange(n) + 0.5)
        beyond = [lower - outside[::-1], upper + outside]
        axes.append(inside if periodic else np.concatenate([beyond[0], inside, beyond[1]]))
    if fluid.dimensions == 2:
        axes[2] = np.array([plane])
    points = np.array(list(itertools.product(*axes)))
    walls = walled(fluid, box)
    return points[np.any((points < walls.lower) | (points > walls.upper), axis=1)]


def walled(fluid: Fluid, box: Box) -> Box:
    """The box, infinite where it has no walls: along periodic axes, and in 2-D along z."""
    walls = ~np.array(box.periodic)
    walls[fluid.dimensions :] = False
    return Box(np.where(walls, box.lower, -np.inf), np.where(walls, box.upper, np.inf))


def nearest_image(r: Array, box: Box | None) -> Array:
    """The difference r of two positions, from the nearest image of the one to the other."""
    if box is None:
        return r
    period = np.where(box.periodic, box.period, 1.0)
    return np.where(box.periodic, r - period * np.round(r / period), r)


def wrap(x: Array, box: Box | None) -> Array:
    """The images of positions in [lower, upper) along the periodic axes."""
    if box is None:
        return x
    period = np.where(box.periodic, box.period, 1.0)
    return np.where(box.periodic, box.lower + np.mod(x - box.lower, period), x)


def project(x: Array, box: Box | None) -> Array:
    """The point of the closed box nearest to x: collision detection and response in one."""
    return x.copy() if box is None else np.clip(x, box.lower, box.upper)


def centers(fluid: Fluid, box: Box | None) -> Box | None:
    """Where particle centers may be: the box less the particle's radius d/2 from every wall."""
    if box is None:
        return None
    walls, radius = walled(fluid, box), fluid.spacing / 2.0
    return Box(walls.lower + radius, walls.upper - radius)
