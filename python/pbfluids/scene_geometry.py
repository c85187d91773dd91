"""Find what is wrong with where the fluid of a scene is."""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from pbfluids import _core
from pbfluids.errors import InvalidParameter
from pbfluids.machine import available_memory
from pbfluids.scene_model import Ball, Block, Domain

# Memory per particle of a simulation and its renderer together: measured, rounded up.
BYTES_PER_PARTICLE = 1024


@dataclass(frozen=True)
class Shape:
    """A block, or a ball with the box around it, and its path inside the scene.

    In 2-D a rectangle or a disk: there is no z.
    """

    path: str
    lower: Sequence[float]
    upper: Sequence[float]
    center: Sequence[float] = ()
    radius: float | None = None

    @classmethod
    def of(cls, path: str, item: Block | Ball, dimensions: int) -> Shape:
        """Make a shape from what the scene says."""
        if isinstance(item, Block):
            return cls(path, item.lower[:dimensions], item.upper[:dimensions])
        center = item.center[:dimensions]
        lower = [x - item.radius for x in center]
        upper = [x + item.radius for x in center]
        return cls(path, lower, upper, center, item.radius)

    def volume(self) -> float:
        """Volume [m^3], in 2-D area [m^2]."""
        if self.radius is not None:
            unit_ball = 4 / 3 * math.pi if len(self.center) == 3 else math.pi
            return unit_ball * math.prod([self.radius] * len(self.center))
        return math.prod(b - a for a, b in zip(self.lower, self.upper, strict=True))

    def overlap(self, other: Shape) -> float:
        """How deep the shapes reach into each other [m]; 0 or less if they do not."""
        if self.radius is None and other.radius is not None:
            return other.overlap(self)
        corners = zip(self.lower, self.upper, other.lower, other.upper, strict=True)
        if self.radius is None:
            return min(min(b, d) - max(a, c) for a, b, c, d in corners)
        if other.radius is not None:
            return self.radius + other.radius - math.dist(self.center, other.center)
        sides = zip(self.center, other.lower, other.upper, strict=True)
        return self.radius - math.dist(self.center, [min(max(x, a), b) for x, a, b in sides])


def geometry_faults(
    items: Sequence[tuple[str, Block | Ball]],
    domain: Domain | None,
    fluid: _core.FluidParams | None,
) -> Iterator[str]:
    """Check blocks and balls, given with their paths, against each other, domain and memory.

    Parameters
    ----------
    items
        What holds fluid, with its path inside the scene.
    domain
        The box around it, None for open space.
    fluid
        Its spacing and dimensions; None if they are not known, and then nothing that they decide
        is checked.

    Yields
    ------
    str
        A line for each fault.
    """
    spacing, dimensions = (fluid.spacing, fluid.dimensions) if fluid else (None, 3)
    shapes = []
    if dimensions == 2:
        yield from _plane_faults(items, spacing or 0.0)
    for shape in (Shape.of(path, item, dimensions) for path, item in items):
        faults = list(_extent_faults(shape, spacing or 0.0))
        yield from faults
        shapes += [] if faults else [shape]
    tolerance = 1e-3 * (spacing or 0.0)
    if domain is not None:
        try:
            box = _core.Box(**domain.model_dump())
            if fluid is not None:
                _core.Simulation(fluid, _core.SolverParams(), box)  # looks whether they fit
        except InvalidParameter as error:
            yield from str(error).replace("Box.", "domain.").splitlines()
        else:
            for shape in shapes:
                yield from _outside_faults(shape, domain, tolerance)
    for a, b in itertools.combinations(shapes, 2):
        if (depth := a.overlap(b)) > tolerance:
            yield f"{b.path}: overlaps {a.path} by {depth:g} m; fluid cannot be there twice"
    if spacing is not None:
        yield from _memory_faults(shapes, spacing)


def _plane_faults(items: Sequence[tuple[str, Block | Ball]], spacing: float) -> Iterator[str]:
    """Check that all fluid lies, and stays, in the plane of the first block or ball."""
    planes = [
        (path, (item.lower[2] + item.upper[2]) / 2 if isinstance(item, Block) else item.center[2])
        for path, item in items
    ]
    for path, z in planes[1:]:
        if abs(z - planes[0][1]) > 1e-3 * spacing:
            yield (
                f"{path}: its plane z = {z:g} m is not that of {planes[0][0]}, z = "
                f"{planes[0][1]:g} m; in 2-D all fluid lies in one plane"
            )
    for path, item in items:
        if isinstance(item, Block) and item.upper[2] < item.lower[2]:
            yield (
                f"{path}.upper[2] = {item.upper[2]:g} m: must be >= lower[2] = {item.lower[2]:g} m"
            )
        if item.velocity[2] != 0:
            yield f"{path}.velocity[2] = {item.velocity[2]:g} m/s: must be 0 in 2-D"


def _extent_faults(shape: Shape, spacing: float) -> Iterator[str]:
    for axis, (a, b) in enumerate(zip(shape.lower, shape.upper, strict=True)):
        if not b > a:
            yield f"{shape.path}.upper[{axis}] = {b:g} m: must be > lower[{axis}] = {a:g} m"
        elif b - a < 0.999 * spacing:
            yield (
                f"{shape.path}: {b - a:g} m along {'xyz'[axis]} is less than fluid.spacing = "
                f"{spacing:g} m; no particle fits in"
            )


def _outside_faults(shape: Shape, domain: Domain, tolerance: float) -> Iterator[str]:
    for axis in range(len(shape.lower)):
        low, high = shape.lower[axis], shape.upper[axis]
        if low < domain.lower[axis] - tolerance:
            wall = domain.lower[axis]
            yield f"{shape.path}: outside the domain, {'xyz'[axis]} = {low:g} m < {wall:g} m"
        if high > domain.upper[axis] + tolerance:
            wall = domain.upper[axis]
            yield f"{shape.path}: outside the domain, {'xyz'[axis]} = {high:g} m > {wall:g} m"


def _memory_faults(shapes: Sequence[Shape], spacing: float) -> Iterator[str]:
    particles = sum(shape.volume() / spacing ** len(shape.lower) for shape in shapes)
    need, have = particles * BYTES_PER_PARTICLE, available_memory()
    if need > have:
        yield (
            f"fluid.spacing = {spacing:g} m: makes about {particles:.2g} particles, which need "
            f"{need / 2**30:.2g} GiB of memory of which {have / 2**30:.2g} GiB are free; enlarge it"
        )
