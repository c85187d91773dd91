"""Write the stubs of the extension: ``python scripts/update_stubs.py``.

They are committed, so that building needs no generator; a test fails when they are not what this
writes.
"""

from __future__ import annotations

import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
STUBS = ROOT / "python" / "pbfluids" / "_core"


def generate() -> dict[str, str]:
    """Give the stubs of the extension that is installed, by file name."""
    with tempfile.TemporaryDirectory() as directory:
        _run("pybind11_stubgen", "--exit-code", "--output-dir", directory, "pbfluids._core")
        files = sorted(Path(directory).rglob("*.pyi"))
        config = f"--config={ROOT / 'pyproject.toml'}"
        _run("ruff", "check", "--quiet", "--fix-only", "--select=I", config, *files)
        _run("ruff", "format", "--quiet", config, *files)
        return {file.name: file.read_text(encoding="utf-8") for file in files}


def _run(module: str, *arguments: str | Path) -> None:
    # Outside the checkout, so that the installed package is imported and not the source tree.
    command = [sys.executable, "-m", module, *map(str, arguments)]
    done = subprocess.run(
        command, check=False, capture_output=True, text=True, cwd=tempfile.gettempdir()
    )
    if done.returncode != 0:
        raise SystemExit(f"{module} failed:\n{done.stdout}{done.stderr}")


if __name__ == "__main__":
    STUBS.mkdir(exist_ok=True)
    for name, text in generate().items():
        (STUBS / name).write_text(text, encoding="utf-8")
        print(STUBS / name)
