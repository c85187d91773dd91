"""Differential operators on values carried by particles.

With V the particle volume and ∇W_ij the kernel's gradient with respect to x_i, sums over all
particles within the support radius:

=========  ===================================================================================
gradient   V Σ_j (A_j − A_i) ∇W_ij
jacobian   V Σ_j (a_j − a_i) ⊗ ∇W_ij, so that J[a, b] = ∂a_a/∂x_b
divergence trace of the Jacobian
curl       (J_zy − J_yz, J_xz − J_zx, J_yx − J_xy)
laplacian  2 V Σ_j (A_i − A_j) (r_ij · ∇W_ij) / (‖r_ij‖² + 0.01 h²), r_ij = x_i − x_j
density    ρ0 V Σ_j W_ij, the particle itself included
=========  ===================================================================================

Constants are differentiated exactly, to zero. ``corrected=True``, the default, multiplies gradients
with the inverse of V Σ (x_j − x_i) ⊗ ∇W, which makes linear fields exact too, at free surfaces as
well. All of it is meant for space: for particles in one plane the kernels, their volume and the
gradients are not those of a fluid in 2-D.

Parameters common to all:

positions : array_like, shape (n, 3)
    [m], finite.
support_radius : float
    Kernel support radius h [m], 1e-6 to 1e6; about twice the particle distance.
volume : float, optional
    Particle volume V [m^3]; by default that of the rest lattice of spacing h/2.
kernel : "poly6_spiky" or "cubic_spline"
    poly6 for values with spiky for gradients, or one cubic spline for both.
num_threads : int
    0 for all. The result has the same bits for any number.

Raises ``InvalidParameter`` for wrong shapes or values and ``WrongType`` for arrays that do not hold
real numbers.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from pbfluids._core import ParticleFields
from pbfluids.errors import InvalidParameter

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

__all__ = ["curl", "density", "divergence", "gradient", "jacobian", "laplacian"]


def _fields(
    positions: ArrayLike,
    support_radius: float,
    volume: float | None,
    kernel: str,
    num_threads: int,
    *,
    corrected: bool = False,
) -> ParticleFields:
    if volume is not None and not volume > 0:
        raise InvalidParameter(f"volume = {volume} m^3: must be finite, > 0")
    return ParticleFields(positions, support_radius, volume or 0.0, kernel, corrected, num_threads)


def density(
    positions: ArrayLike,
    *,
    support_radius: float,
    rest_density: float = 1000.0,
    volume: float | None = None,
    kernel: str = "poly6_spiky",
    num_threads: int = 0,
) -> NDArray[np.float32]:
    """Density at each particle.

    Parameters
    ----------
    positions : array_like, shape (n, 3)
        [m].
    support_radius : float
        Kernel support radius h [m], 1e-6 to 1e6.
    rest_density : float
        Density of the rest lattice [kg/m^3]; 1 gives the ratio to it.
    volume, kernel, num_threads
        See the module.

    Returns
    -------
    ndarray, shape (n,), float32
        [kg/m^3]. Without boundary particles: low at walls and free surfaces.

    """
    fields = _fields(positions, support_radius, volume, kernel, num_threads)
    return fields.relative_density() * np.float32(rest_density)


def gradient(
    values: ArrayLike,
    positions: ArrayLike,
    *,
    support_radius: float,
    corrected: bool = True,
    volume: float | None = None,
    kernel: str = "poly6_spiky",
    num_threads: int = 0,
) -> NDArray[np.float32]:
    """Gradient of a scalar field.

    Parameters
    ----------
    values : array_like, shape (n,)
        The field at each particle.
    positions : array_like, shape (n, 3)
        [m].
    support_radius : float
        Kernel support radius h [m], 1e-6 to 1e6.
    corrected : bool
        Exact for linear fields. Without it a gradient is the plain sum, which in the bulk of a
        lattice is 0.947 (poly6_spiky) or 1.020 (cubic_spline) of the truth at h = 2 spacings, and
        less at free surfaces.
    volume, kernel, num_threads
        See the module.

    Returns
    -------
    ndarray, shape (n, 3), float32
        [unit of values / m].

    """
    fields = _fields(positions, support_radius, volume, kernel, num_threads, corrected=corrected)
    return fields.gradient(values)


def jacobian(
    values: ArrayLike,
    positions: ArrayLike,
    *,
    support_radius: float,
    corrected: bool = True,
    volume: float | None = None,
    kernel: str = "poly6_spiky",
    num_threads: int = 0,
) -> NDArray[np.float32]:
    """Jacobian of a vector field: ``J[i, a, b]`` is the derivative of component a along axis b.

    Parameters
    ----------
    values : array_like, shape (n, 3)
        The field at each particle.
    positions : array_like, shape (n, 3)
        [m].
    support_radius : float
        Kernel support radius h [m], 1e-6 to 1e6.
    corrected : bool
        Exact for linear fields. Without it a gradient is the plain sum, which in the bulk of a
        lattice is 0.947 (poly6_spiky) or 1.020 (cubic_spline) of the truth at h = 2 spacings, and
        less at free surfaces.
    volume, kernel, num_threads
        See the module.

    Returns
    -------
    ndarray, shape (n, 3, 3), float32
        [unit of values / m].

    """
    fields = _fields(positions, support_radius, volume, kernel, num_threads, corrected=corrected)
    return fields.jacobian(values)


def divergence(
    values: ArrayLike,
    positions: ArrayLike,
    *,
    support_radius: float,
    corrected: bool = True,
    volume: float | None = None,
    kernel: str = "poly6_spiky",
    num_threads: int = 0,
) -> NDArray[np.float32]:
    """Divergence of a vector field.

    Parameters
    ----------
    values : array_like, shape (n, 3)
        The field at each particle.
    positions : array_like, shape (n, 3)
        [m].
    support_radius : float
        Kernel support radius h [m], 1e-6 to 1e6.
    corrected : bool
        Exact for linear fields. Without it a gradient is the plain sum, which in the bulk of a
        lattice is 0.947 (poly6_spiky) or 1.020 (cubic_spline) of the truth at h = 2 spacings, and
        less at free surfaces.
    volume, kernel, num_threads
        See the module.

    Returns
    -------
    ndarray, shape (n,), float32
        [unit of values / m].

    """
    fields = _fields(positions, support_radius, volume, kernel, num_threads, corrected=corrected)
    return fields.divergence(values)


def curl(
    values: ArrayLike,
    positions: ArrayLike,
    *,
    support_radius: float,
    corrected: bool = True,
    volume: float | None = None,
    kernel: str = "poly6_spiky",
    num_threads: int = 0,
) -> NDArray[np.float32]:
    """Curl of a vector field; of a velocity field, the vorticity.

    Parameters
    ----------
    values : array_like, shape (n, 3)
        The field at each particle.
    positions : array_like, shape (n, 3)
        [m].
    support_radius : float
        Kernel support radius h [m], 1e-6 to 1e6.
    corrected : bool
        Exact for linear fields. Without it a gradient is the plain sum, which in the bulk of a
        lattice is 0.947 (poly6_spiky) or 1.020 (cubic_spline) of the truth at h = 2 spacings, and
        less at free surfaces.
    volume, kernel, num_threads
        See the module.

    Returns
    -------
    ndarray, shape (n, 3), float32
        [unit of values / m].

    """
    fields = _fields(positions, support_radius, volume, kernel, num_threads, corrected=corrected)
    return fields.curl(values)


def laplacian(
    values: ArrayLike,
    positions: ArrayLike,
    *,
    support_radius: float,
    volume: float | None = None,
    kernel: str = "poly6_spiky",
    num_threads: int = 0,
) -> NDArray[np.float32]:
    """Laplacian of a scalar field, in Brookshaw's form.

    Parameters
    ----------
    values : array_like, shape (n,)
        The field at each particle.
    positions : array_like, shape (n, 3)
        [m].
    support_radius : float
        Kernel support radius h [m], 1e-6 to 1e6.
    volume, kernel, num_threads
        See the module.

    Returns
    -------
    ndarray, shape (n,), float32
        [unit of values / m^2]. Meaningful in the bulk; at free surfaces half of the sum is missing.

    """
    return _fields(positions, support_radius, volume, kernel, num_threads).laplacian(values)
