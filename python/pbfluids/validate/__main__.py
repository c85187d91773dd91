"""Run validation cases: ``python -m pbfluids.validate [CASE…]``."""

from __future__ import annotations

import argparse
import json
import sys
import time
import traceback
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from pbfluids import files
from pbfluids._version import __version__
from pbfluids.errors import FluidError, InvalidParameter, WrongType
from pbfluids.validate import CASES, load, report
from pbfluids.validate.case import Check, Frames, Settings

FAILURE, BAD_INPUT, INTERRUPTED = 1, 2, 130


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command.

    Parameters
    ----------
    arguments
        What follows the command's name; those of the process if not given.

    Returns
    -------
    int
        0 if every case ran, marks missed or not; 1 if one could not, 2 for bad input, 130 after
        Ctrl-C.
    """
    given = _parser().parse_args(arguments)
    try:
        report.check()
        if given.write_docs is not None:
            print(report.write_page(given.out, given.write_docs))
            return 0
        failed = [name for name in given.cases or CASES if not _run(name, given)]
    except KeyboardInterrupt:
        print("pbfluids.validate: interrupted; the cases before are written", file=sys.stderr)
        return INTERRUPTED
    except (FluidError, OSError) as error:
        print(f"pbfluids.validate: {error}", file=sys.stderr)
        return BAD_INPUT if isinstance(error, InvalidParameter | WrongType) else FAILURE
    return FAILURE if failed else 0


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog="python -m pbfluids.validate",
        description="Compare the solver with experiments, exact solutions and invariants.",
        epilog="A case whose mark is missed has run: the exit code is 0, and the table says MISS.",
    )
    parser.add_argument(
        "cases",
        nargs="*",
        metavar="CASE",
        type=_case,
        help=", ".join(CASES) + "; all if not given",
    )
    parser.add_argument(
        "--out",
        type=Path,
        default=Path("out/validation"),
        metavar="DIR",
        help="where numbers (JSON) and plots go [default: %(default)s]",
    )
    parser.add_argument(
        "--threads", type=int, default=0, metavar="N", help="0 for all; the result is the same"
    )
    parser.add_argument("--quick", action="store_true", help="coarser and shorter, as tests do")
    parser.add_argument(
        "--write-docs",
        type=Path,
        metavar="DOCS",
        help="simulate nothing, but write DOCS/validation.md and its plots from the JSON in --out",
    )
    return parser


def _case(name: str) -> str:
    if name not in CASES:
        raise argparse.ArgumentTypeError(f"no case is called {name}; known: {', '.join(CASES)}")
    return name


def _run(name: str, given: argparse.Namespace) -> bool:
    """Run a case and write what it found; whether it could run."""
    from pbfluids.progress import Progress

    start = time.perf_counter()
    try:
        with Progress(name) as progress:
            settings = Settings(Frames(progress.update), given.quick, given.threads)
            result = load(name).run(settings)
    except Exception:  # whatever it is: the other cases shall run
        print(f"pbfluids.validate: {name} could not run", file=sys.stderr)
        traceback.print_exc()
        return False
    record: dict[str, Any] = {
        "case": name,
        "version": __version__,
        "quick": given.quick,
        "seconds": round(time.perf_counter() - start, 1),
        **result.as_dict(),
    }
    text = json.dumps(record, indent=1, ensure_ascii=False) + "\n"
    files.write(given.out / f"{name}.json", text.encode())
    report.write_plot(record, given.out / f"{name}.png")
    print(f"{name}  ({record['seconds']:g} s)")
    for check in result.checks:
        print(f"  {_line(check)}")
    for words, value in result.values.items():
        print(f"        {words}: {value:.4g}")
    return True


def _line(check: Check) -> str:
    word = "ok  " if check.passed else "MISS"
    found, mark = (f"{number:.3g} {check.unit}".strip() for number in (check.value, check.mark))
    return f"{word}  {check.name}: {found} (mark {mark})"


if __name__ == "__main__":
    raise SystemExit(main())
