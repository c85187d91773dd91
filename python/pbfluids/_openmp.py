"""Loads the extension, and with it OpenMP, so that threads sleep while they wait.

By default they spin, and as soon as another process wants a core every barrier costs a time slice:
a step of 4 000 particles took 30 times as long on a busy machine with 2 cores. OpenMP reads its
environment once, when it is loaded; what the user has set there stands.
"""

from __future__ import annotations

import os

if "OMP_WAIT_POLICY" in os.environ:
    from pbfluids import _core
else:
    os.environ["OMP_WAIT_POLICY"] = "passive"
    try:
        from pbfluids import _core
    finally:
        del os.environ["OMP_WAIT_POLICY"]

__all__ = ["_core"]
