"""Smoothing filters of a layer of a picture, plain and slow, with rows and columns as they come.

Layers are affine depth (1/d in perspective, -d in parallel projection) or thickness; what is not
there is NaN. Every filter fits a line, or in two dimensions a plane, to what is around a pixel by
weighted least squares and takes its value there.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from reference.params import Array

MOST_TAPS = 24
STEPS_PER_ITERATION = 3
MOST_STAGES = 24


@dataclass(frozen=True)
class View:
    """A camera's picture: lengths in the world, in pixels and in affine depth."""

    width: int
    height: int
    half_height: float  # of what is seen [m], in perspective at depth 1
    perspective: bool = True

    @property
    def pixels_per_meter(self) -> float:
        """In perspective at depth 1."""
        return self.height / (2 * self.half_height)

    def affine(self, depth: Array) -> Array:
        """Affine depth of depth in m; 0 is nothing."""
        with np.errstate(divide="ignore"):
            a = 1 / depth if self.perspective else -depth
        return np.where(depth > 0, a, np.nan)

    def depth(self, a: Array) -> Array:
        """Depth in m."""
        return np.nan_to_num(1 / a if self.perspective else -a)

    def scale(self, a: Array) -> Array:
        """Pixels that a meter covers."""
        return self.pixels_per_meter * (a if self.perspective else np.ones_like(a))

    def farther(self, a: Array, length: float) -> Array:
        """How much less affine depth is a length farther away."""
        return a - 1 / (1 / a + length) if self.perspective else np.full_like(a, length)

    def nearer(self, a: Array, length: float) -> Array:
        """How much more it is a length nearer, at most at half the depth."""
        if not self.perspective:
            return np.full_like(a, length)
        return 1 / np.maximum(1 / a - length, 0.5 / a) - a

    def rays(self) -> tuple[Array, Array]:
        """Slopes of the pixels' rays; the first row is the lowest."""
        x = (2 * (np.arange(self.width) + 0.5) / self.width - 1) * self.width / self.height
        y = 2 * (np.arange(self.height) + 0.5) / self.height - 1
        slopes = np.meshgrid(x * self.half_height, y * self.half_height)
        return tuple(s * self.perspective for s in slopes)  # type: ignore[return-value]


@dataclass(frozen=True)
class Window:
    """Lengths of the layer's own kind at each pixel: down and up to where the range ends, and to
    where narrow_range puts what is farther down."""

    down: Array
    up: Array
    behind: Array


def shifted(values: Array, dx: Array | int, dy: Array | int) -> Array:
    """Value of the pixel that is dx to the right and dy up; NaN beyond the border."""
    y, x = np.indices(values.shape)
    x, y = x + dx, y + dy
    there = (x >= 0) & (x < values.shape[1]) & (y >= 0) & (y < values.shape[0])
    return np.where(there, values[np.where(there, y, 0), np.where(there, x, 0)], np.nan)


def strides(radius: Array) -> tuple[Array, Array]:
    """Pixels from tap to tap, and the radius in taps."""
    stride = np.maximum(np.ceil(np.nan_to_num(radius) / MOST_TAPS), 1).astype(int)
    return stride, np.nan_to_num(radius) / stride


def space_weight(distance: Array, reach: Array) -> Array:
    """Gaussian of the distance in taps that fades out beyond its end."""
    with np.errstate(divide="ignore", invalid="ignore"):
        gauss = np.exp(-2 * distance**2 / reach**2)
    return np.where(reach > 0, gauss, 0) * np.clip(reach + 1 - distance, 0, 1)


def bilateral_weight(difference: Array, window: Window) -> Array:
    """(1 - u^2)^2 within the range."""
    u = np.maximum(-difference / window.down, difference / window.up)
    return np.maximum(1 - u**2, 0) ** 2


class Fit:
    """Weighted least squares of v = c0 + c1 x + c2 y at every pixel, its own v = 0 first."""

    def __init__(self, shape: tuple[int, ...], unknowns: int) -> None:
        """Start with the pixel itself."""
        self.matrix = np.zeros((*shape, unknowns, unknowns))
        self.matrix[..., 0, 0] = 1
        self.right = np.zeros((*shape, unknowns))

    def add(self, place: list[Array], difference: Array, weight: Array) -> None:
        """Add a neighbor of every pixel; NaN is none."""
        weight = np.where(np.isnan(difference), 0, weight)
        row = np.stack(np.broadcast_arrays(np.ones_like(weight), *place), axis=-1)
        self.matrix += weight[..., None, None] * row[..., None] * row[..., None, :]
        self.right += (weight * np.nan_to_num(difference))[..., None] * row

    def value(self) -> Array:
        """c0, or 0 where the neighbors do not span the space."""
        scale = self.matrix[..., :1, :1]
        solvable = np.abs(np.linalg.det(self.matrix / scale)) > 1e-6
        matrix = np.where(solvable[..., None, None], self.matrix, np.eye(self.right.shape[-1]))
        return np.where(solvable, np.linalg.solve(matrix, self.right[..., None])[..., 0, 0], 0)


def smooth_axis(values: Array, radius: Array, window: Window, kind: str, axis: int) -> Array:
    """One axis of a separable filter: 0 along the rows, 1 along the columns."""
    stride, reach = strides(radius)
    fit = Fit(values.shape, 2)
    low, high = -window.down, window.up
    still = [np.ones(values.shape, dtype=bool) for _ in range(2)]
    for k in range(1, int(np.ceil(reach.max())) + 1):
        step = k * stride
        pair = [
            shifted(values, s * step * (axis == 0), s * step * (axis == 1)) - values
            for s in (1, -1)
        ]
        weight = space_weight(np.full(values.shape, float(k)), reach)
        weights = [weight, weight]
        if kind == "bilateral":
            weights = [weight * bilateral_weight(d, window) for d in pair]
        if kind == "narrow_range":
            still = [s & ~np.isnan(d) for s, d in zip(still, pair, strict=True)]
            pair = [np.where(s, d, np.nan) for s, d in zip(still, pair, strict=True)]
            kept = ~((pair[0] > high) | (pair[1] > high))
            inside = [np.where(kept & ~(d < low) & ~np.isnan(d), d, 0) for d in pair]
            pair = [np.where(d < low, -window.behind, d) for d in pair]
            weights = [weight * kept] * 2
            high = np.where(kept, np.maximum(high, np.maximum(*inside) + window.up), high)
            low = np.where(kept, np.minimum(low, np.minimum(*inside) - window.down), low)
        for sign, d, w in zip((1.0, -1.0), pair, weights, strict=True):
            fit.add([np.full(values.shape, sign * k)], d, w)
    return values + fit.value()


def smooth_plane(values: Array, radius: Array, window: Window, kind: str) -> Array:
    """The true filter in two dimensions."""
    stride, reach = strides(radius)
    most = int(np.ceil(reach.max()))
    places = [
        (dx, dy)
        for dx in range(-most, most + 1)
        for dy in range(-most, most + 1)
        if 0 < np.hypot(dx, dy) < most + 1
    ]
    places.sort(key=lambda p: (np.hypot(*p), p))  # near to far, a pixel before its mirror image
    fit = Fit(values.shape, 3)
    low, high = -window.down, window.up
    for dx, dy in [p for p in places if p > (0, 0)]:
        pair = [shifted(values, s * dx * stride, s * dy * stride) - values for s in (1, -1)]
        weight = space_weight(np.full(values.shape, np.hypot(dx, dy)), reach)
        weights = [weight, weight]
        if kind == "bilateral":
            weights = [weight * bilateral_weight(d, window) for d in pair]
        if kind == "narrow_range":
            kept = ~((pair[0] > high) | (pair[1] > high))
            inside = [np.where(kept & ~(d < low) & ~np.isnan(d), d, 0) for d in pair]
            pair = [np.where(d < low, -window.behind, d) for d in pair]
            weights = [weight * kept] * 2
            high = np.where(kept, np.maximum(high, np.maximum(*inside) + window.up), high)
            low = np.where(kept, np.minimum(low, np.minimum(*inside) - window.down), low)
        for sign, d, w in zip((1.0, -1.0), pair, weights, strict=True):
            fit.add([np.full(values.shape, sign * n) for n in (dx, dy)], d, w)
    return values + fit.value()


def depth_window(a: Array, view: View, range_: float, behind: float) -> Window:
    """Window of a range and a length, both in m, at affine depths."""
    return Window(view.farther(a, range_), view.nearer(a, range_), view.farther(a, behind))


def smooth_depth(
    a: Array, view: View, kind: str, radius: float, range_: float, behind: float = 0.0
) -> Array:
    """One iteration of a separable filter: rows, then columns."""
    for axis in (0, 1):
        window = depth_window(a, view, range_, behind)
        a = smooth_axis(a, radius * view.scale(a), window, kind, axis)
    return a


def flow_schedule(
    view: View, radius: float, iterations: int, nearest: float
) -> tuple[int, int, float]:
    """Steps, stages of a step, and D T of a step [m^2]."""
    variance = 0.5 * (0.5 * radius) ** 2 / STEPS_PER_ITERATION
    scale = view.pixels_per_meter / (nearest if view.perspective else 1)
    corner2 = view.half_height**2 * (1 + (view.width / view.height) ** 2)
    needed = variance * scale**2 * (2 + corner2 * view.perspective)
    stages = 1
    while stages < MOST_STAGES and 0.45 * (stages**2 + stages) / 2 < needed:
        stages += 1
    return STEPS_PER_ITERATION * iterations, stages, variance


def curvature(a: Array, view: View, range_: float, variance: float, far: float) -> Array:
    """Change of affine depth by motion along the normal by the mean curvature, in D T / far."""
    window = depth_window(a, view, range_, 0.0)

    def differences(dx: int, dy: int) -> tuple[Array, Array, Array]:
        pair = []
        for sign in (1, -1):
            d = shifted(a, sign * dx, sign * dy) - a
            pair.append(np.where((d >= -window.down) & (d <= window.up), d, np.nan))
        both = ~np.isnan(pair[0]) & ~np.isnan(pair[1])
        straight = [np.where(np.isnan(p), -q, p) for p, q in (pair, pair[::-1])]
        return np.nan_to_num(straight[0]), np.nan_to_num(straight[1]), both

    (east, west, x_both), (north, south, y_both) = differences(1, 0), differences(0, 1)
    ne, sw, rising = differences(1, 1)
    se, nw, falling = differences(1, -1)
    a_xy = np.where(x_both & y_both & rising & falling, (ne + sw - se - nw) / 4, 0)
    gradient = [view.pixels_per_meter * (p - q) / 2 for p, q in ((east, west), (north, south))]
    rays = view.rays()
    n_z = a - rays[0] * gradient[0] - rays[1] * gradient[1] if view.perspective else np.ones_like(a)
    length = np.sqrt(gradient[0] ** 2 + gradient[1] ** 2 + n_z**2)
    t = [(g - n_z * r) / length for g, r in zip(gradient, rays, strict=True)]
    m = [[float(i == j) + rays[i] * rays[j] - t[i] * t[j] for j in range(2)] for i in range(2)]
    time = np.minimum(variance * view.scale(a) ** 2, 0.45 * far / (m[0][0] + m[1][1]))
    second = m[0][0] * (east + west) + 2 * m[0][1] * a_xy + m[1][1] * (north + south)
    return time / far * second


def curvature_flow(
    a: Array, view: View, radius: float, range_: float, iterations: int, nearest: float
) -> Array:
    """All iterations."""
    steps, stages, variance = flow_schedule(view, radius, iterations, nearest)
    far = 0.5 * (stages**2 + stages)
    for _ in range(steps):
        before = last = a
        for j in range(1, stages + 1):
            moved = last + curvature(last, view, range_, variance, far)
            before, last = last, (2 * j - 1) / j * moved - (j - 1) / j * before
        a = last
    return a
