"""Cases with known answers: ``python -m pbfluids.validate``.

Experiments, exact solutions, invariants. A case is a module of `pbfluids.validate.cases` with the
members of `pbfluids.validate.case.Case`.
"""

from __future__ import annotations

from importlib import import_module
from typing import cast

from pbfluids.validate.case import Case

__all__ = ["CASES", "load"]

CASES = (
    "dam_break_front",
    "hydrostatic_tank",
    "elliptical_drop",
    "oscillating_drop",
    "collision",
    "energy",
    "independence",
    "taylor_green",
)


def load(name: str) -> Case:
    """Import a case, one of `CASES`."""
    return cast("Case", import_module(f"pbfluids.validate.cases.{name}"))
