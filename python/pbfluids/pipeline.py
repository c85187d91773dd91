"""Work on several items at the same time, each at another stage."""

from __future__ import annotations

import math
import queue
import signal
import threading
from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import contextmanager
from typing import Any

__all__ = ["run"]

_END = object()
_PATIENCE = 0.05  # longest that a wait keeps Ctrl-C waiting [s]


def run(
    source: Iterable[Any],
    stages: Sequence[Callable[[Any], Any]],
    finished: Callable[[Any], None],
) -> None:
    """Do ``for item in source: finished(stage_2(stage_1(item)))``, all stages at the same time.

    Each stage has a thread of its own. The source is read, and `finished` is called, in the
    caller's thread. Items keep their order, and of each stage there is one item at work and one
    that waits, so a slow stage makes those before it wait and memory is bounded.

    What the source, a stage or `finished` raises comes out after the items before it have gone
    through all stages; of several errors that of the first item. A second Ctrl-C drops them.

    Parameters
    ----------
    source
        Gives the items.
    stages
        Called with an item each; what they return goes to the next.
    finished
        Called with what the last stage has returned.
    """
    line = _Line(stages)
    try:
        for item in source:
            if not line.put(item):
                break
            line.give(finished, wait=False)
    finally:
        try:
            line.put_end()
            line.give(finished, wait=True)
            line.join()
        except BaseException:
            line.drop()
            raise
    line.check()


@contextmanager
def _undisturbed() -> Iterator[None]:
    """Let Ctrl-C wait for the end of this block.

    Queues are Python: what interrupts one while it takes its lock leaves the lock taken for ever.
    """
    pending: list[Any] = []
    before = signal.getsignal(signal.SIGINT)
    if threading.current_thread() is not threading.main_thread() or before is None:
        yield
        return
    signal.signal(signal.SIGINT, lambda *arguments: pending.append(arguments))
    try:
        yield
    finally:
        signal.signal(signal.SIGINT, before)
        if pending and callable(before):
            before(*pending[0])


class _Line:
    """The threads of the stages and the queues between them."""

    def __init__(self, stages: Sequence[Callable[[Any], Any]]) -> None:
        self._lock = threading.Lock()
        self._stop = math.inf  # the item that failed; those before it go on, the rest is dropped
        self._error: BaseException | None = None
        self._count = 0
        self._done: queue.Queue[Any] = queue.Queue()
        queues: list[queue.Queue[Any]] = [*(queue.Queue(1) for _ in stages), self._done]
        self._first = queues[0]
        self._threads = [
            threading.Thread(target=self._work, args=arguments, daemon=True)
            for arguments in zip(stages, queues, queues[1:], strict=False)
        ]
        for thread in self._threads:
            thread.start()

    def put(self, item: Any) -> bool:
        """Hand over an item; whether that makes sense, since no stage has failed."""
        self._put((self._count, item))
        self._count += 1
        return self._error is None

    def put_end(self) -> None:
        self._put(_END)

    def _put(self, entry: Any) -> None:
        waiting = True
        while waiting:
            with _undisturbed():
                try:
                    self._first.put(entry, timeout=_PATIENCE)
                    waiting = False
                except queue.Full:
                    pass

    def give(self, finished: Callable[[Any], None], *, wait: bool) -> None:
        """Pass on what has gone through: so far, or all until the end."""
        while True:
            entry = None
            with _undisturbed():
                try:
                    entry = self._done.get(timeout=_PATIENCE if wait else 0)
                except queue.Empty:
                    if not wait:
                        return
            if entry is _END:
                return
            if entry is not None:
                finished(entry[1])

    def drop(self) -> None:
        """Let each stage end what it has at work, and no more."""
        self._fail(-1, None)
        self.put_end()  # again, in case it was this that was interrupted; one too many is harmless
        self.join()

    def join(self) -> None:
        for thread in self._threads:
            while thread.is_alive():
                with _undisturbed():
                    thread.join(_PATIENCE)

    def check(self) -> None:
        if self._error is not None:
            raise self._error

    def _fail(self, number: int, error: BaseException | None) -> None:
        with self._lock:
            if number < self._stop:
                self._stop, self._error = number, error

    def _work(
        self, stage: Callable[[Any], Any], source: queue.Queue[Any], target: queue.Queue[Any]
    ) -> None:
        while (entry := source.get()) is not _END:
            number, item = entry
            del entry  # while it waits for the next, a stage must not keep this one alive
            if number < self._stop:
                try:
                    item = stage(item)
                    target.put((number, item))
                except BaseException as error:
                    self._fail(number, error)
            del item
        target.put(_END)
