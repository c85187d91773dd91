"""The committed stub is the one of the extension."""

from __future__ import annotations

import difflib
import runpy
from pathlib import Path

SCRIPT = runpy.run_path(str(Path(__file__).resolve().parents[2] / "scripts" / "update_stubs.py"))


def test_the_committed_stub_is_up_to_date():
    committed = SCRIPT["STUB"].read_text(encoding="utf-8").splitlines()
    generated = SCRIPT["generate"]().splitlines()
    difference = list(difflib.unified_diff(committed, generated, "committed", "generated", n=1))
    assert not difference, "run scripts/update_stubs.py:\n" + "\n".join(difference)
