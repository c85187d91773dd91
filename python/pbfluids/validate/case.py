"""What a validation case is made of."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import asdict, dataclass, field
from typing import Any, Protocol, TypeVar

import numpy as np
import numpy.typing as npt

from pbfluids.simulation import Simulation, SolverParams

__all__ = [
    "Case",
    "Check",
    "Frames",
    "Result",
    "Settings",
    "Vectors",
    "history",
    "kinetic_energy",
    "rms",
]

Vectors = npt.NDArray[np.float64]
T = TypeVar("T")


@dataclass(frozen=True)
class Check:
    """A measure and the mark it is held against: passed if its size is at most the mark.

    Attributes
    ----------
    name
        What is measured, in a few words.
    value, mark
        The error found and the largest one that passes, both in `unit`.
    unit
        A unit, ``%`` or nothing for a pure number.
    """

    name: str
    value: float
    mark: float
    unit: str = ""

    @property
    def passed(self) -> bool:
        """Whether the measure is within the mark; a number that is not finite never is."""
        return abs(self.value) <= self.mark


@dataclass
class Result:
    """What a case found.

    Attributes
    ----------
    checks
        What has a mark.
    values
        What is worth knowing besides, by a name that ends with the unit.
    series
        Lists of numbers, what the plot shows.
    """

    checks: list[Check] = field(default_factory=list)
    values: dict[str, float] = field(default_factory=dict)
    series: dict[str, Any] = field(default_factory=dict)

    def check(self, name: str, value: float, mark: float, unit: str = "") -> None:
        """Add a measure with its mark."""
        self.checks.append(Check(name, float(value), mark, unit))

    def as_dict(self) -> dict[str, Any]:
        """Give what JSON takes."""
        checks = [asdict(check) | {"passed": check.passed} for check in self.checks]
        return {"checks": checks, "values": self.values, "series": self.series}


class Frames:
    """Counts the frames of a case for its progress bar.

    Parameters
    ----------
    update
        Takes the frames done, those in all, and a word on the last.
    """

    def __init__(self, update: Callable[[int, int, str], None]) -> None:
        self._update = update
        self._done = self._total = 0

    def expect(self, count: int) -> None:
        """Say how many there will be."""
        self._total = count

    def tick(self, note: str = "") -> None:
        """Count one."""
        self._done += 1
        self._update(self._done, self._total, note)


@dataclass(frozen=True)
class Settings:
    """How a case is to run.

    Attributes
    ----------
    frames
        To be told of every frame.
    quick
        Whether coarser and shorter, for a test of the case itself.
    threads
        0 for all; the result is the same.
    """

    frames: Frames
    quick: bool = False
    threads: int = 0

    def solver(self, **changes: Any) -> SolverParams:
        """Make the solver's default parameters with some changes."""
        return SolverParams(num_threads=self.threads, **changes)


class Case(Protocol):
    """A module of `pbfluids.validate.cases`; its docstring says what is compared with what."""

    __doc__: str | None
    DISCUSSION: str  # for the page: how the case is built, why it misses where it does

    @staticmethod
    def run(settings: Settings) -> Result:
        """Simulate and measure."""

    @staticmethod
    def plot(result: dict[str, Any], figure: Any) -> None:
        """Draw a result as read from JSON into a matplotlib figure."""


def history(
    simulation: Simulation,
    count: int,
    length: float,
    settings: Settings,
    note: str,
    measure: Callable[[Simulation], T],
) -> list[T]:
    """Advance by frames and measure at the start and after each.

    Parameters
    ----------
    simulation
        What to advance.
    count, length
        How many frames, of how many seconds.
    settings
        Whose progress is told.
    note
        What the progress says about this simulation.
    measure
        What to find.

    Returns
    -------
    list
        `count` + 1 findings.
    """
    found = [measure(simulation)]
    for _ in range(count):
        simulation.advance(length)
        found.append(measure(simulation))
        settings.frames.tick(note)
    return found


def kinetic_energy(simulation: Simulation) -> float:
    """Mean kinetic energy [J/kg]."""
    return float(0.5 * np.mean(np.sum(simulation.velocities.astype(float) ** 2, axis=1)))


def rms(values: npt.ArrayLike) -> float:
    """Root of the mean square."""
    return float(np.sqrt(np.mean(np.square(values))))
