"""An ellipse of ideal fluid in the plane: what the elliptical and the oscillating drop obey."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

__all__ = ["semi_axes", "solution"]

Values = npt.NDArray[np.float64]


def solution(rate: float, frequency: float, t: Values) -> Values:
    """Semi-axes (a, b) at the times `t`, from a unit circle, by Runge and Kutta.

    With **v** = (σ x, −σ y) and the central force −Ω² **x** [MR13]:
    a' = σ a,  b' = −σ b,  σ' = (σ² + Ω²) (b² − a²)/(b² + a²).

    Parameters
    ----------
    rate
        σ at t = 0 [1/s].
    frequency
        Ω [1/s].
    t
        Times [s], increasing from 0.

    Returns
    -------
    ndarray, shape (n, 2)
        In units of the radius at the start.
    """

    def slope(state: Values) -> Values:
        a, b, sigma = state
        pull = (sigma**2 + frequency**2) * (b**2 - a**2) / (b**2 + a**2)
        return np.array([sigma * a, -sigma * b, pull])

    state = np.array([1.0, 1.0, rate])
    states = [state]
    for step in np.diff(t):
        k1 = slope(state)
        k2 = slope(state + step / 2 * k1)
        k3 = slope(state + step / 2 * k2)
        k4 = slope(state + step * k3)
        state = state + step / 6 * (k1 + 2 * k2 + 2 * k3 + k4)
        states.append(state)
    return np.array(states)[:, :2]


def semi_axes(x: npt.NDArray[np.float32]) -> Values:
    """Semi-axes [m] of the upright ellipse with the particles' second moments."""
    centered = x[:, :2].astype(float) - x[:, :2].mean(axis=0, dtype=float)
    axes: Values = 2 * np.sqrt(np.mean(centered**2, axis=0))
    return axes
