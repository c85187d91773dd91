"""Fail on an include that runs against the dependency picture, or on a word in the wrong room.

Run as ``python scripts/check_layers.py [ROOT]``; prints one line per fault, exit code 1 if any.
"""

from __future__ import annotations

import re
import sys
from collections.abc import Iterator
from pathlib import Path

# The picture of docs/architecture.md: each room of cpp/pbf and the rooms it may include.
SIMULATION_BASE = {"core", "kernels", "neighbors"}
MAY_INCLUDE: dict[str, set[str]] = {
    "core": set(),
    "kernels": {"core"},
    "neighbors": {"core"},
    "boundary": SIMULATION_BASE,
    "fluid": SIMULATION_BASE | {"boundary"},
    "scene": SIMULATION_BASE | {"boundary", "fluid"},
    "gl": {"core"},
    "render": {"core", "neighbors", "gl"},
}

# (pattern, files of cpp/pbf that may hold it, why nobody else may)
WORDS: list[tuple[str, str, str]] = [
    (
        r"#\s*pragma\s+omp|<omp\.h>|\bomp_\w+\(",
        r"core/(parallel|threads)\.[hc]pp",
        "OpenMP stays in core/parallel and core/threads",
    ),
    (
        r"\bgl[A-Z]\w+|\bGL_[A-Z]\w+|\begl[A-Z]\w+|\bEGL_?[A-Z]\w+",
        r"(gl|render)/.*",
        "GL and EGL stay in gl/ and render/",
    ),
    (
        r"#\s*pragma\s+omp\s+atomic|\breduction\s*\(",
        r"(?!)",
        "the result would depend on the order of the threads",
    ),
    (r"\bunordered_|std::hash\b", r"(?!)", "the order would depend on the standard library"),
    (r"\b(std::)?(exit|abort|terminate)\s*\(", r"(?!)", "no input may end the process"),
]

INCLUDE = re.compile(r'^\s*#\s*include\s*"([^"]+)"')


def faults_in(path: Path, name: str) -> Iterator[str]:
    """Yield one message per fault of the file; ``name`` is its path below cpp/pbf."""
    room = name.split("/", maxsplit=1)[0]
    if room not in MAY_INCLUDE:
        yield f"cpp/pbf/{name}: room '{room}' is not in the picture of scripts/check_layers.py"
        return
    for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), start=1):
        where = f"cpp/pbf/{name}:{number}"
        include = INCLUDE.match(line)
        if include:
            target = include.group(1).split("/")
            if target[0] != "pbf" or len(target) < 3:
                yield f'{where}: "{include.group(1)}": write it as "pbf/<room>/<file>"'
            elif target[1] != room and target[1] not in MAY_INCLUDE[room]:
                allowed = ", ".join(sorted(MAY_INCLUDE[room])) or "nothing"
                yield f"{where}: {room} must not include {target[1]} (it may include {allowed})"
        code = line.split("//", maxsplit=1)[0]
        for pattern, places, reason in WORDS:
            found = re.search(pattern, code)
            if found and not re.fullmatch(places, name):
                yield f"{where}: '{found.group(0)}': {reason}"


def check(root: Path) -> list[str]:
    """Return the faults of every C++ file below ``root/cpp/pbf``, in path order."""
    base = root / "cpp" / "pbf"
    files = sorted(path for path in base.rglob("*") if path.suffix in {".hpp", ".cpp", ".inl"})
    if not files:
        return [f"{base}: no C++ files found; is this the root of the repository?"]
    return [fault for path in files for fault in faults_in(path, path.relative_to(base).as_posix())]


def main() -> int:
    """Print the faults; return the exit code."""
    root = Path(sys.argv[1]) if len(sys.argv) > 1 else Path(__file__).resolve().parent.parent
    faults = check(root)
    for fault in faults:
        print(fault)
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
