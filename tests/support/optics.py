"""Closed forms of light at a smooth surface, and the light that pixels stand for."""

from __future__ import annotations

from typing import Any

import numpy as np


def linear(image: Any) -> Any:
    """Light of sRGB-encoded values, 0 to 255."""
    v = np.asarray(image, float) / 255
    return np.where(v <= 0.04045, v / 12.92, ((v + 0.055) / 1.055) ** 2.4)


def fresnel(cosine: Any, index: float = 1.333) -> Any:
    """Share of unpolarized light that a dielectric mirrors, by the cosine of incidence."""
    inside = np.sqrt(1 - (1 - cosine**2) / index**2)
    s = (cosine - index * inside) / (cosine + index * inside)
    p = (index * cosine - inside) / (index * cosine + inside)
    return (s * s + p * p) / 2
