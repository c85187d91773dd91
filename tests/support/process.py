"""Python code in a process of its own: what it does to the process is seen from outside."""

from __future__ import annotations

import os
import subprocess
import sys

TIME_LIMIT = 120  # s; a hang is an error


def run_python(
    code: str, *, time_limit: float = TIME_LIMIT, **environment: str
) -> subprocess.CompletedProcess[str]:
    """Run code in a new interpreter that knows this package; give the finished process."""
    return subprocess.run(
        [sys.executable, "-c", code],
        env={**os.environ, "PYTHONPATH": os.pathsep.join(sys.path), **environment},
        capture_output=True,
        text=True,
        timeout=time_limit,
        check=False,
    )
