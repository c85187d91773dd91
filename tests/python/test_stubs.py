"""The committed stubs are those of the extension."""

from __future__ import annotations

import difflib
import runpy
from pathlib import Path

SCRIPT = runpy.run_path(str(Path(__file__).resolve().parents[2] / "scripts" / "update_stubs.py"))


def test_the_committed_stubs_are_up_to_date():
    generated = SCRIPT["generate"]()
    committed = {
        path.name: path.read_text(encoding="utf-8") for path in SCRIPT["STUBS"].glob("*.pyi")
    }
    assert sorted(committed) == sorted(generated)
    difference = [
        line
        for name, text in generated.items()
        for line in difflib.unified_diff(
            committed[name].splitlines(), text.splitlines(), "committed", "generated", n=1
        )
    ]
    assert not difference, "run scripts/update_stubs.py:\n" + "\n".join(difference)
