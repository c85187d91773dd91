"""A process that waits at a pipe to be asked: until then others have the machine to themselves."""

from __future__ import annotations

import multiprocessing
import os
from collections.abc import Callable, Mapping
from multiprocessing.connection import Connection
from typing import Any


class Child:
    """Runs ``serve(name, case, pipe)`` elsewhere. Raises EOFError if that has died.

    What it sends first, unasked, is its `greeting`.
    """

    def __init__(
        self,
        serve: Callable[[str, Any, Connection], None],
        name: str,
        case: Any,
        environment: Mapping[str, str] | None = None,
    ) -> None:
        self.name = name
        context = multiprocessing.get_context("spawn")
        self.pipe, theirs = context.Pipe()
        self.process = context.Process(target=serve, args=(name, case, theirs), daemon=True)
        before = dict(os.environ)
        os.environ.update(environment or {})  # the child inherits it
        self.process.start()
        os.environ.clear()
        os.environ.update(before)
        theirs.close()
        self.greeting: Any = self.pipe.recv()

    def run(self, asked: float) -> Any:
        self.pipe.send(asked)
        return self.pipe.recv()

    def close(self) -> None:
        self.process.terminate()
        self.process.join()
