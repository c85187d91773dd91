"""Plots of what the cases found, and the page about it."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

from pbfluids import files
from pbfluids.errors import InvalidParameter, MissingExtra
from pbfluids.validate import CASES, load

__all__ = ["check", "write_page", "write_plot"]

HEAD = """\
# Validation

Written by `python -m pbfluids.validate --write-docs docs` from the numbers of a run of
`python -m pbfluids.validate`, which takes some minutes on two cores. Every measure has a mark
that its size must not exceed. A miss is shown as a miss, with its reason as far as found.
"""


def check() -> None:
    """See that what cases need is installed.

    Raises
    ------
    MissingExtra
        If matplotlib or rich is not.
    """
    try:
        import matplotlib.figure  # noqa: F401
        import rich  # noqa: F401
    except ImportError as error:
        raise MissingExtra(
            "validation needs matplotlib and rich: pip install 'pbfluids[validate]'"
        ) from error


def write_plot(record: dict[str, Any], path: Path) -> None:
    """Draw a case's record, as read from JSON, into a PNG file."""
    from matplotlib.figure import Figure

    figure = Figure(figsize=(8, 3.6), dpi=90, layout="constrained")
    load(record["case"]).plot(record, figure)
    figure.savefig(path)


def write_page(numbers: Path, docs: Path) -> Path:
    """Write the page and its plots.

    Parameters
    ----------
    numbers
        The directory of the run, with a JSON file for every case.
    docs
        Where validation.md goes, and the plots in images/validation.

    Returns
    -------
    Path
        The page.

    Raises
    ------
    InvalidParameter
        If the numbers of a case are missing or those of a quick run.
    """
    records = [_read(numbers / f"{name}.json") for name in CASES]
    images = docs / "images" / "validation"
    images.mkdir(parents=True, exist_ok=True)
    for record in records:
        write_plot(record, images / f"{record['case']}.png")
    parts = [HEAD, _summary(records), *map(_section, records)]
    page = docs / "validation.md"
    files.write(page, "\n".join(parts).encode())
    return page


def _read(path: Path) -> dict[str, Any]:
    try:
        record: dict[str, Any] = json.loads(path.read_text(encoding="utf-8"))
    except OSError as error:
        raise InvalidParameter(
            f"{path}: cannot be read: run `python -m pbfluids.validate {path.stem}` first"
        ) from error
    if record["quick"]:
        raise InvalidParameter(f"{path}: is of a quick run; the page is for a whole one")
    return record


def _summary(records: list[dict[str, Any]]) -> str:
    rows = ["| case | passed | time of the run |", "|---|---|---|"]
    for record in records:
        name, checks = record["case"], record["checks"]
        passed = sum(entry["passed"] for entry in checks)
        rows.append(
            f"| [{name}](#{name}) | {passed} of {len(checks)} | {record['seconds']:.0f} s |"
        )
    return "\n".join(rows) + "\n"


def _section(record: dict[str, Any]) -> str:
    name = record["case"]
    case = load(name)
    rows = ["| measure | found | mark | |", "|---|---:|---:|---|"]
    for entry in record["checks"]:
        verdict = "ok" if entry["passed"] else "**miss**"
        found, mark = (f"{entry[key]:.3g} {entry['unit']}".strip() for key in ("value", "mark"))
        rows.append(f"| {entry['name']} | {found} | {mark} | {verdict} |")
    rows += [f"| {words} | {value:.4g} | | |" for words, value in record["values"].items()]
    return "\n".join(
        [
            f"## {name}\n",
            f"{(case.__doc__ or '').strip()}\n",
            f"{case.DISCUSSION}\n",
            *rows,
            f"\n![{name}](images/validation/{name}.png)\n",
        ]
    )
