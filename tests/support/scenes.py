"""Scenes for tests."""

from __future__ import annotations

from typing import Any

# 64 particles, 3 frames.
TINY: dict[str, Any] = {
    "schema": 1,
    "name": "tiny",
    "duration": 0.1,
    "frame_rate": 20,
    "fluid": {"spacing": 0.05},
    "solver": {"iterations": 2, "substeps": 1},
    "domain": {"lower": [0.0, 0.0, 0.0], "upper": [0.4, 0.4, 0.2]},
    "blocks": [{"lower": [0.0, 0.0, 0.0], "upper": [0.2, 0.2, 0.2]}],
}
