"""The pages agree with the code and with one another."""

from __future__ import annotations

import re
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
PAGES = [*ROOT.glob("*.md"), *(ROOT / "docs").glob("*.md"), *(ROOT / "bench").glob("*.md")]
SUFFIXES = {".hpp", ".cpp", ".py", ".md", ".vert", ".frag", ".glsl", ".toml"}
ROOMS = ("cpp", "glsl", "python", "docs", "tests", "scenes", "bench")


def citations() -> dict[str, str]:
    """Key of each citation in code and docs → a file that has it."""
    found = {}
    for room in ROOMS:
        for path in (ROOT / room).rglob("*"):
            if path.suffix in SUFFIXES:
                keys = re.findall(
                    r"\[((?=\w*[A-Z])[A-Za-z]{2,7}\d\d)\]", path.read_text(encoding="utf-8")
                )
                found |= dict.fromkeys(keys, str(path))
    return found


def entries() -> set[str]:
    text = (ROOT / "docs" / "references.bib").read_text(encoding="utf-8")
    return set(re.findall(r"^@\w+\{(\w+),", text, re.MULTILINE))


def test_every_citation_resolves_in_the_bibliography():
    missing = {key: path for key, path in citations().items() if key not in entries()}
    assert not missing


def test_every_entry_of_the_bibliography_is_cited():
    assert entries() <= set(citations())


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.name)
def test_links_between_pages_lead_somewhere(page):
    links = re.findall(r"\]\(([^)#]+)[^)]*\)", page.read_text(encoding="utf-8"))
    broken = [
        link for link in links if "://" not in link and not (page.parent / link).resolve().exists()
    ]
    assert not broken


def test_the_generated_pages_are_up_to_date():
    script = ROOT / "scripts" / "update_docs.py"
    done = subprocess.run(
        [sys.executable, script, "--check"], capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stdout + done.stderr


def test_no_path_in_the_map_of_contributing_is_stale():
    text = (ROOT / "CONTRIBUTING.md").read_text(encoding="utf-8")
    paths = re.findall(r"`((?:cpp|glsl|python|cmake|scripts|scenes|tests)/[^`<>* ]*)`", text)
    assert len(paths) > 10
    files = [form for path in paths for form in expanded(path)]
    assert not [path for path in files if not (ROOT / path).exists()]


def expanded(path: str) -> list[str]:
    """Write a/{b,c} as a/b and a/c."""
    braces = re.search(r"\{([^}]*)\}", path)
    if not braces:
        return [path]
    return [path.replace(braces.group(0), word) for word in braces.group(1).split(",")]
