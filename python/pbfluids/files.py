"""Files that are either there and complete, or not there."""

from __future__ import annotations

import os
from pathlib import Path
from types import TracebackType

__all__ = ["Replacement", "write"]


class Replacement:
    """A file beside `path` that takes its place when the context ends well.

    After an exception the file beside is gone and what was at `path` is still there.

    Parameters
    ----------
    path
        The name in the end.
    """

    def __init__(self, path: Path) -> None:
        self.path = path
        self.beside = path.with_name(f".{os.getpid()}.{path.name}")

    def __enter__(self) -> Replacement:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        try:
            if kind is None:
                self.beside.replace(self.path)
        finally:
            self.discard()

    def discard(self) -> None:
        """Remove the file beside."""
        self.beside.unlink(missing_ok=True)


def write(path: Path, data: bytes) -> None:
    """Write a whole file at once, and the directories above it."""
    path.parent.mkdir(parents=True, exist_ok=True)
    with Replacement(path) as file:
        file.beside.write_bytes(data)
