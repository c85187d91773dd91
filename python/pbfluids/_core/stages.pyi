"""
The solver's stages one by one; each call searches neighbors anew.
"""

from __future__ import annotations
import numpy
import numpy.typing
import pbfluids._core
import typing

__all__: list[str] = [
    "boundary_particles",
    "calibration",
    "confine",
    "corrections",
    "kernel",
    "multipliers",
    "neighbor_pairs",
    "predict",
    "project",
    "vorticity",
    "xsph",
]

def boundary_particles(
    positions: typing.Any, fluid: pbfluids._core.FluidParams, box: pbfluids._core.Box | None
) -> tuple:
    """
    (offsets, q): row i's boundary particles are q[offsets[i]:offsets[i + 1]] [m].
    """

def calibration(fluid: pbfluids._core.FluidParams) -> tuple:
    """
    (V [m^3], D_ideal [1/m^2]).
    """

def confine(
    positions: typing.Any,
    velocities: typing.Any,
    omega: typing.Any,
    fluid: pbfluids._core.FluidParams,
    strength: typing.SupportsFloat | typing.SupportsIndex,
    dt: typing.SupportsFloat | typing.SupportsIndex,
) -> numpy.typing.NDArray[numpy.float32]:
    """
    Velocities after vorticity confinement [m/s].
    """

def corrections(
    x_star: typing.Any,
    multipliers: typing.Any,
    fluid: pbfluids._core.FluidParams,
    solver: pbfluids._core.SolverParams,
    box: pbfluids._core.Box | None,
) -> numpy.typing.NDArray[numpy.float32]:
    """
    Corrections [m].
    """

def kernel(fluid: pbfluids._core.FluidParams, r: typing.Any) -> tuple:
    """
    (W [1/m^3], grad W [1/m^4]) at the offsets r [m].
    """

def multipliers(
    x_star: typing.Any,
    fluid: pbfluids._core.FluidParams,
    solver: pbfluids._core.SolverParams,
    box: pbfluids._core.Box | None,
) -> tuple:
    """
    (densities [kg/m^3], multipliers [m^2]).
    """

def neighbor_pairs(positions: typing.Any, h: typing.SupportsFloat | typing.SupportsIndex) -> tuple:
    """
    (i, j) of all pairs closer than h, sorted.
    """

def predict(
    positions: typing.Any,
    velocities: typing.Any,
    fluid: pbfluids._core.FluidParams,
    box: pbfluids._core.Box | None,
    dt: typing.SupportsFloat | typing.SupportsIndex,
) -> tuple:
    """
    (v + dt g [m/s], x* [m]).
    """

def project(
    positions: typing.Any, box: pbfluids._core.Box | None
) -> numpy.typing.NDArray[numpy.float32]:
    """
    The nearest points in the box [m].
    """

def vorticity(
    positions: typing.Any, velocities: typing.Any, fluid: pbfluids._core.FluidParams
) -> numpy.typing.NDArray[numpy.float32]:
    """
    Vorticity [1/s].
    """

def xsph(
    positions: typing.Any,
    velocities: typing.Any,
    fluid: pbfluids._core.FluidParams,
    strength: typing.SupportsFloat | typing.SupportsIndex,
) -> numpy.typing.NDArray[numpy.float32]:
    """
    Velocities after XSPH [m/s].
    """
