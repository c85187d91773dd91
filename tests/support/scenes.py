"""Scenes for tests."""

from __future__ import annotations

from typing import Any

import pytest

import pbfluids as pbf
from pbfluids import errors

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


def faults_of(data: dict[str, Any]) -> list[str]:
    """Every fault that the error names, a line each."""
    with pytest.raises(errors.SceneError) as caught:
        pbf.Scene(data)
    return [line.strip() for line in str(caught.value).splitlines()[1:]]
