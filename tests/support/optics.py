"""Closed forms of light at a smooth surface."""

from __future__ import annotations

from typing import Any

import numpy as np


def fresnel(cosine: Any, index: float = 1.333) -> Any:
    """Share of unpolarized light that a dielectric mirrors, by the cosine of incidence."""
    inside = np.sqrt(1 - (1 - cosine**2) / index**2)
    s = (cosine - index * inside) / (cosine + index * inside)
    p = (index * cosine - inside) / (index * cosine + inside)
    return (s * s + p * p) / 2
