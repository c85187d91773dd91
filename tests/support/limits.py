"""Values just outside the range of a parameter."""

from __future__ import annotations

import math
from typing import Any


def beyond(field: dict[str, Any], end: str) -> float | None:
    """Return a value outside the "least" or "most" end, not to be rounded in; None if open."""
    limit, sign = field[end], -1 if end == "least" else 1
    if not math.isfinite(limit):
        return None
    if field[f"{end}_excluded"] and limit == 0:
        return 0.0
    step = 1e-3 * abs(limit)
    value = limit + sign * (step if field[f"{end}_excluded"] else 1 + step)
    return math.floor(value) if field["kind"] == "int" else value
