"""The solver's Python face."""

from __future__ import annotations

import warnings
from typing import TYPE_CHECKING

import numpy as np

from pbfluids import _core
from pbfluids._core import Box, FluidParams, SolverParams, StepReport

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from numpy.typing import ArrayLike, NDArray

__all__ = ["Box", "FluidParams", "Simulation", "SolverParams", "StepReport", "ball", "block"]


def block(
    lower: Sequence[float], upper: Sequence[float], spacing: float, dimensions: int = 3
) -> NDArray[np.float32]:
    """Particles on a cubic lattice that fill a box.

    The first layer lies half a spacing inside ``lower``; as many layers follow as fit. A block next
    to the walls of the domain is at rest density there.

    Parameters
    ----------
    lower, upper : three numbers
        Opposite corners [m].
    spacing : float
        Distance of neighbors [m], > 0.
    dimensions : 3 or 2
        2: one layer of the square lattice in x and y, at the z midway between the corners, for a
        fluid of as many dimensions.

    Returns
    -------
    ndarray, shape (n, 3), float32
        Positions [m].

    Raises
    ------
    InvalidParameter
        If ``upper`` is less than ``lower`` on an axis, the spacing not positive, or the dimensions
        neither 2 nor 3.

    """
    return _core.block(lower, upper, spacing, dimensions)


def ball(
    center: Sequence[float], radius: float, spacing: float, dimensions: int = 3
) -> NDArray[np.float32]:
    """Particles on a cubic lattice that fill a ball.

    Parameters
    ----------
    center : three numbers
        [m].
    radius : float
        [m], >= 0.
    spacing : float
        Distance of neighbors [m], > 0.
    dimensions : 3 or 2
        2: a disk of the square lattice in x and y, at the z of the center.

    Returns
    -------
    ndarray, shape (n, 3), float32
        Positions [m].

    Raises
    ------
    InvalidParameter
        If the radius is negative, the spacing not positive, or the dimensions neither 2 nor 3.

    """
    return _core.ball(center, radius, spacing, dimensions)


def _warned(report: StepReport) -> StepReport:
    """Say where the time step is too long for the fluid to stay one."""
    if not report.stable:
        from pbfluids.errors import UnstableTimeStep

        warnings.warn(
            f"the fluid is crushed to {1 + report.mean_density_error:.1f} times its density: the "
            'time step is too long; use shorter ones (more substeps, or time_step="adaptive"), '
            "more iterations, or the pressure method",
            UnstableTimeStep,
            stacklevel=3,
        )
    return report


class Simulation:
    """Position Based Fluids [MM13]_.

    Every array is in the order of ``ids``, the order in which particles were added, and is a copy:
    it stays as it is when the simulation goes on. Several threads may call one simulation; their
    calls take turns. Results have the same bits for any number of threads.

    Parameters
    ----------
    fluid : FluidParams, optional
        What the fluid is.
    solver : SolverParams, optional
        How the constraint is solved.
    domain : Box, optional
        The tank; without it space is open. Along its periodic axes there are no walls, and a period
        is at least two support radii.

    Raises
    ------
    InvalidParameter
        If a parameter breaks its rule, or the domain is thinner than the spacing or, along a
        periodic axis, than two support radii.

    References
    ----------
    .. [MM13] M. Macklin and M. Müller, "Position Based Fluids", ACM Transactions on Graphics 32(4),
       2013.

    Examples
    --------
    >>> import pbfluids as pbf
    >>> sim = pbf.Simulation(pbf.FluidParams(spacing=0.05), domain=pbf.Box((0, 0, 0), (1, 1, 1)))
    >>> ids = sim.add_particles(pbf.block((0, 0, 0), (0.5, 0.5, 0.5), spacing=0.05))
    >>> len(sim)
    1000
    >>> sim.step(0.002).iterations > 0
    True

    """

    def __init__(
        self,
        fluid: FluidParams | None = None,
        solver: SolverParams | None = None,
        *,
        domain: Box | None = None,
    ) -> None:
        self._core = _core.Simulation(fluid or FluidParams(), solver or SolverParams(), domain)

    def add_particles(
        self, positions: ArrayLike, velocities: ArrayLike | None = None
    ) -> NDArray[np.int64]:
        """Add particles.

        Parameters
        ----------
        positions : array_like, shape (n, 3)
            [m], finite, within the domain and 2^20 support radii of the origin; what lies on the
            upper face of a periodic axis is moved to the lower one, which is the same place. In 2-D
            all have the same z, that of the first particle ever added, and z of the domain does not
            matter.
        velocities : array_like, shape (n, 3), optional
            [m/s], finite; in 2-D z is 0. At rest if not given.

        Returns
        -------
        ndarray, shape (n,), int64
            The new particles' ids: their rows in every array of this simulation.

        Raises
        ------
        InvalidParameter
            If a shape is wrong, a value not finite, or a position outside the domain or, like a
            velocity, the plane of a fluid in 2-D.
        WrongType
            If an array does not hold real numbers.

        """
        return self._core.add_particles(positions, velocities)

    def step(self, dt: float) -> StepReport:
        """Advance by one time step: Algorithm 1 of [MM13]_.

        Parameters
        ----------
        dt : float
            Time step [s], >= 1e-15. A particle should move less than half a support radius in it.

        Returns
        -------
        StepReport
            Iterations, mean and largest density error [-], milliseconds by stage.

        Raises
        ------
        InvalidParameter
            If ``dt`` is not finite or too short.
        SimulationFailed
            If positions stop being finite or particles pile up. The state is that before the call,
            to the bits of the steps that follow.

        Warns
        -----
        UnstableTimeStep
            If the fluid is crushed to twice its density in the mean.

        """
        return _warned(self._core.step(dt))

    def advance(
        self,
        seconds: float,
        *,
        frames: int = 1,
        progress: Callable[[int, int], None] | None = None,
    ) -> StepReport:
        """Advance by a frame, or several, of ``solver.substeps`` time steps each.

        Ctrl-C ends it after the time step under way.

        Parameters
        ----------
        seconds : float
            Length of a frame [s], >= 1e-12.
        frames : int
            How many, >= 1.
        progress : callable, optional
            Called with (frames done, frames in all) after each.

        Returns
        -------
        StepReport
            Of all the steps: iterations and milliseconds added up, mean and largest density error.

        """
        if frames < 1:
            from pbfluids.errors import InvalidParameter

            raise InvalidParameter(f"frames = {frames}: must be >= 1")
        report = None
        for done in range(1, frames + 1):
            latest = _warned(self._core.advance(seconds))
            if report is None:
                report = latest
            else:
                report.add(latest)
            if progress is not None:
                progress(done, frames)
        assert report is not None
        return report

    @property
    def positions(self) -> NDArray[np.float32]:
        """Positions, shape (n, 3) [m]; along periodic axes in [lower, upper)."""
        return self._core.positions()

    @property
    def velocities(self) -> NDArray[np.float32]:
        """Velocities, shape (n, 3) [m/s]."""
        return self._core.velocities()

    @property
    def densities(self) -> NDArray[np.float32]:
        """Densities at the present positions, boundary particles included, shape (n,) [kg/m^3]."""
        return self._core.densities()

    @property
    def multipliers(self) -> NDArray[np.float32]:
        """Lagrange multipliers of the last iteration, shape (n,) [m^2]; 0 before the first step."""
        return self._core.multipliers()

    @property
    def pressures(self) -> NDArray[np.float32]:
        """Pressures of the last time step, shape (n,) [Pa]; 0 before the first step.

        What its corrections amount to as forces: a third of the trace of the mean virial [IK50]_ of
        -rest_density * (sum of the step's multipliers) / dt^2, half of a pair's force to either
        side. With the pressure method this is the fluid's pressure; the plain method's few
        iterations find a part of it. Found when asked for, at the cost of a neighbor search.
        """
        return self._core.pressures()

    @property
    def ids(self) -> NDArray[np.int64]:
        """Ids, shape (n,): 0, 1, 2, … in the order in which particles were added."""
        return self._core.ids()

    @property
    def time(self) -> float:
        """Time simulated so far [s]."""
        return self._core.time()

    @property
    def step_count(self) -> int:
        """Time steps so far."""
        return self._core.step_count()

    @property
    def fluid(self) -> FluidParams:
        """What the fluid is: a copy."""
        return self._core.fluid()

    @property
    def solver(self) -> SolverParams:
        """How the constraint is solved: a copy; assign to change it between steps."""
        return self._core.solver()

    @solver.setter
    def solver(self, solver: SolverParams) -> None:
        self._core.set_solver(solver)

    @property
    def domain(self) -> Box | None:
        """The tank: a copy, or None for open space."""
        return self._core.domain()

    def __len__(self) -> int:
        """Count the particles."""
        return self._core.size()

    def __repr__(self) -> str:
        """Say what it holds and how far it has come."""
        return f"Simulation({len(self)} particles, time={self.time:.6g} s, domain={self.domain!r})"

    def state_hash(self) -> str:
        """Hash time, step count, positions and velocities.

        Returns
        -------
        str
            16 hexadecimal digits, equal if and (all but surely) only if the states have equal bits.

        """
        return f"{self._core.state_hash():016x}"
