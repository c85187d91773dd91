"""How far a run is: a bar on a terminal, plain lines elsewhere. Always on stderr."""

from __future__ import annotations

import sys
import time
from types import TracebackType

from rich import progress
from rich.console import Console

__all__ = ["Progress"]

_LINE_INTERVAL = 2.0  # s


class Progress:
    """Shows frames done; a context manager.

    Parameters
    ----------
    title
        What is going on.
    """

    def __init__(self, title: str) -> None:
        self._title = title
        self._start = self._last_line = time.monotonic()
        self._bar = _Bar(title) if sys.stderr.isatty() else None

    def update(self, done: int, total: int, note: str = "") -> None:
        """Say how many frames are done, and what there is to say about the last."""
        if self._bar is not None:
            self._bar.update(done, total, note)
            return
        now = time.monotonic()
        if done < total and now - self._last_line < _LINE_INTERVAL:
            return
        self._last_line = now
        left = (now - self._start) / done * (total - done)
        parts = [f"{self._title}: frame {done}/{total}", note, f"{left:.0f} s left"]
        print(", ".join(filter(None, parts)), file=sys.stderr)

    def __enter__(self) -> Progress:
        if self._bar is not None:
            self._bar.start()
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        if self._bar is not None:
            self._bar.stop()


class _Bar:
    def __init__(self, title: str) -> None:
        self._progress = progress.Progress(
            progress.TextColumn("{task.description}"),
            progress.BarColumn(),
            progress.MofNCompleteColumn(),
            progress.TextColumn("{task.fields[note]}"),
            progress.TimeElapsedColumn(),
            progress.TimeRemainingColumn(),
            console=Console(stderr=True),
        )
        self._task = self._progress.add_task(title, total=None, note="")
        self.start, self.stop = self._progress.start, self._progress.stop

    def update(self, done: int, total: int, note: str) -> None:
        self._progress.update(self._task, completed=done, total=total, note=note)
