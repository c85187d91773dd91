"""Differentiate fields carried by particles: ``python examples/03_fields.py``.

A ball that rotates rigidly has the curl 2 Ω and no divergence; the corrected operators say so up to
its surface, where a plain sum lacks neighbors.
"""

from __future__ import annotations

import numpy as np

import pbfluids as pbf

SPACING = 0.02
OMEGA = np.array([0.0, 3.0, 0.0])


def main() -> dict[str, float]:
    """Print and return the largest errors."""
    x = pbf.ball((0, 0, 0), 0.2, spacing=SPACING)
    velocities = np.cross(OMEGA, x)
    errors = {}
    for name, corrected in [("plain", False), ("corrected", True)]:
        curl = pbf.operators.curl(velocities, x, support_radius=2 * SPACING, corrected=corrected)
        divergence = pbf.operators.divergence(
            velocities, x, support_radius=2 * SPACING, corrected=corrected
        )
        errors[name] = float(np.abs(curl - 2 * OMEGA).max())
        print(
            f"{name:10} largest error of the curl {errors[name]:.2g} 1/s, "
            f"of the divergence {np.abs(divergence).max():.2g} 1/s"
        )
    return errors


if __name__ == "__main__":
    main()
