"""Write docs/parameters.md from the parameter structs' own description.

``python scripts/update_docs.py`` writes, ``--check`` only compares; exit code 1 if they differ.
"""

from __future__ import annotations

import math
import sys
from pathlib import Path
from typing import Any

import pbfluids as pbf

PAGE = Path(__file__).resolve().parent.parent / "docs" / "parameters.md"
STRUCTS = [
    (pbf.FluidParams, "What the fluid is. In a scene: `[fluid]`."),
    (pbf.SolverParams, "How the constraint is solved. In a scene: `[solver]`."),
    (pbf.Box, "The walls of a tank. In a scene: `[domain]`, without defaults."),
    (pbf.Camera, "Where the fluid is seen from. In a scene: `[camera]`."),
    (
        pbf.RenderParams,
        (
            "How the fluid is drawn. In a scene: `[render]`, which has two keys more. `color_by`: "
            "`speed`, `density`, `pressure` or `id` gives each particle its value, and range and "
            "legend that fit all of the scene's frames. `environment_map`: a file of light "
            "([surroundings.md](surroundings.md)), with which `background` and `reflection` are "
            "`map` unless given."
        ),
    ),
]
HEAD = """# Parameters

Written by `make docs` from the structs in `cpp/pbf`, where names, units, ranges and defaults have
their only home; `FluidParams.describe()` and its like give the same to a program. Values out of
range raise `InvalidParameter`. A unit of – means a pure number.
"""


def text_of(value: Any) -> str:
    """Write a default as Python would; the bits of a float32 are no news."""
    if value is None:
        return "none"
    if isinstance(value, (tuple, list)):
        return "(" + ", ".join(text_of(item) for item in value) + ")"
    if isinstance(value, float):
        return f"{value:.5g}".replace("e+0", "e").replace("e-0", "e-")
    return f"`{value}`" if isinstance(value, str) else str(value)


def range_of(field: dict[str, Any]) -> str:
    """Write the allowed values, in the notation of intervals."""
    if field["choices"]:
        return ", ".join(f"`{choice}`" for choice in field["choices"])
    if field["kind"] in {"bool", "bool3", "string"}:
        return ""
    least, most = field["least"], field["most"]
    if math.isinf(least) and math.isinf(most):
        return "finite" if field["finite"] else "any"
    open_left = field["least_excluded"] or (math.isinf(least) and field["finite"])
    open_right = field["most_excluded"] or math.isinf(most)
    left, right = "(" if open_left else "[", ")" if open_right else "]"
    return f"{left}{text_of(least)}, {text_of(most)}{right}".replace("inf", "∞")


def row_of(field: dict[str, Any]) -> str:
    """Write a field as a row of the table."""
    cells = [
        f"`{field['name']}`",
        field["kind"],
        field["unit"] or "–",
        range_of(field),
        text_of(field["default"]),
        field["doc"].replace("|", "\\|"),
    ]
    return "| " + " | ".join(cells) + " |"


def page() -> str:
    """Write the whole page."""
    parts = [HEAD]
    for struct, sentence in STRUCTS:
        rows = "\n".join(row_of(field) for field in struct.describe())
        head = "| name | kind | unit | range | default | meaning |\n|---|---|---|---|---|---|"
        parts.append(f"## {struct.__name__}\n\n{sentence}\n\n{head}\n{rows}\n")
    return "\n".join(parts)


def main() -> int:
    """Write or compare; return the exit code."""
    wanted = page()
    if sys.argv[1:] == ["--check"]:
        if PAGE.read_text(encoding="utf-8") == wanted:
            return 0
        print(f"{PAGE.name} is out of date; run: make docs")
        return 1
    PAGE.write_text(wanted, encoding="utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main())
