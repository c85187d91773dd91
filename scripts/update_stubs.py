"""Write python/pbfluids/_core.pyi from the built extension: ``python scripts/update_stubs.py``.

The stub is committed, so that building needs no generator; a test fails when it is not what this
writes.
"""

from __future__ import annotations

import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
STUB = ROOT / "python" / "pbfluids" / "_core.pyi"


def generate() -> str:
    """Give the stub of the extension that is installed."""
    with tempfile.TemporaryDirectory() as directory:
        _run("pybind11_stubgen", "--exit-code", "--output-dir", directory, "pbfluids._core")
        stub = Path(directory) / "pbfluids" / "_core.pyi"
        config = str(ROOT / "pyproject.toml")
        _run(
            "ruff", "check", "--quiet", "--fix-only", "--select=I,F401", f"--config={config}", stub
        )
        _run("ruff", "format", "--quiet", f"--config={config}", stub)
        return stub.read_text(encoding="utf-8")


def _run(module: str, *arguments: str | Path) -> None:
    # Outside the checkout, so that the installed package is imported and not the source tree.
    command = [sys.executable, "-m", module, *map(str, arguments)]
    done = subprocess.run(
        command, check=False, capture_output=True, text=True, cwd=tempfile.gettempdir()
    )
    if done.returncode != 0:
        raise SystemExit(f"{module} failed:\n{done.stdout}{done.stderr}")


if __name__ == "__main__":
    STUB.write_text(generate(), encoding="utf-8")
    print(STUB)
