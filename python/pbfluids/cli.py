"""The command ``pbfluids``: exit codes and error messages; `commands` has the commands."""

from __future__ import annotations

import os
import sys
from collections.abc import Sequence

from pbfluids.errors import FluidError, InvalidParameter, MissingExtra, WrongType

__all__ = ["Interrupted", "main"]

FAILURE, BAD_INPUT, INTERRUPTED = 1, 2, 130


class Interrupted(Exception):
    """Ctrl-C; not KeyboardInterrupt, of which typer makes what its version likes."""


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command.

    Parameters
    ----------
    arguments
        What follows the command's name; those of the process if not given.

    Returns
    -------
    int
        0, 1 after a failure, 2 for bad input, 130 after Ctrl-C.
    """
    given = list(sys.argv[1:] if arguments is None else arguments)
    debug = "--debug" in given  # anywhere, not only before the command
    try:
        return _run([argument for argument in given if argument != "--debug"])
    except (KeyboardInterrupt, Interrupted):
        return _fail("interrupted; the files written so far are complete", INTERRUPTED)
    except (FluidError, OSError, MemoryError) as error:
        if debug:
            raise
        if isinstance(error, BrokenPipeError):  # the reader of a pipe has had enough
            os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
            return FAILURE
        bad_input = isinstance(error, InvalidParameter | WrongType)
        return _fail(str(error) or "out of memory", BAD_INPUT if bad_input else FAILURE)


def _run(arguments: list[str]) -> int:
    try:
        from pbfluids.commands import app
    except ModuleNotFoundError as error:
        if error.name not in ("typer", "rich"):
            raise
        raise MissingExtra(
            "the command line needs typer and rich: pip install 'pbfluids[cli]'"
        ) from error
    try:
        app(arguments, prog_name="pbfluids")
    except SystemExit as finished:
        return finished.code if isinstance(finished.code, int) else 0
    return 0


def _fail(message: str, code: int) -> int:
    print(f"pbfluids: {message}", file=sys.stderr)
    return code
