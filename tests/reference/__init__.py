"""A slow, plain float64 Position Based Fluids in NumPy: the yardstick of the compiled solver.

Every function restates one formula of the method, in its own words and with no shortcut, so that it
can be read beside the equation. Particle i is row i. Names and units are those of the library:
V volume [m^3], W kernel [1/m^3], grad_W [1/m^4], C constraint [-], multipliers [m^2].

[MM13] M. Macklin, M. Mueller. Position Based Fluids. ACM TOG 32(4), 2013.
[MCG03] M. Mueller, D. Charypar, M. Gross. Particle-Based Fluid Simulation. SCA 2003.
[Mon92] J. Monaghan. Smoothed Particle Hydrodynamics. Annu. Rev. Astron. Astrophys. 30, 1992.
[Wen95] H. Wendland. Piecewise Polynomial, Positive Definite and Compactly Supported Radial
        Functions of Minimal Degree. Adv. Comput. Math. 4, 1995.
[Bro85] L. Brookshaw. A Method of Calculating Radiative Heat Diffusion in Particle Simulations.
        Proc. ASA 6(2), 1985.
"""

from __future__ import annotations

from reference import operators
from reference.boundary import boundary_lattice, centers, nearest_image, project, wrap
from reference.calibration import calibration, lattice
from reference.density import corrections, density_constraint, multipliers
from reference.kernels import (
    cubic_spline,
    cubic_spline_gradient,
    kernel,
    poly6,
    spiky_gradient,
    wendland,
    wendland_gradient,
)
from reference.neighbors import Neighbors, find_neighbors, pairs_within
from reference.params import Box, Fluid, Solver
from reference.pressure import largest_eigenvalue, solve_pressures, virial_pressures
from reference.solver import (
    State,
    confine,
    predict,
    step,
    vorticity,
    xsph,
)

__all__ = [
    "Box",
    "Fluid",
    "Neighbors",
    "Solver",
    "State",
    "boundary_lattice",
    "calibration",
    "centers",
    "confine",
    "corrections",
    "cubic_spline",
    "cubic_spline_gradient",
    "density_constraint",
    "find_neighbors",
    "kernel",
    "largest_eigenvalue",
    "lattice",
    "multipliers",
    "nearest_image",
    "operators",
    "pairs_within",
    "poly6",
    "predict",
    "project",
    "solve_pressures",
    "spiky_gradient",
    "step",
    "virial_pressures",
    "vorticity",
    "wendland",
    "wendland_gradient",
    "wrap",
    "xsph",
]
