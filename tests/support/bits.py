"""Whether results are the same to the last bit."""

from __future__ import annotations

import pbfluids as pbf


def hash_after_fifty_steps(simulation: pbf.Simulation) -> str:
    for _ in range(50):
        simulation.step(0.002)
    return simulation.state_hash()
