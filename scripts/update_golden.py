"""Draw the golden pictures of tests/golden again: ``python scripts/update_golden.py [NAME ...]``.

Says how far each is from what it was. Look at them before you commit them.
"""

from __future__ import annotations

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "tests"))

from support.golden import FOLDER, GOLDEN, difference, keep, kept


def main(names: list[str]) -> int:
    """Write the pictures of these names, or all; return the exit code."""
    if unknown := set(names) - set(GOLDEN):
        known = ", ".join(GOLDEN)
        print(f"no picture is called {', '.join(sorted(unknown))}; known: {known}", file=sys.stderr)
        return 2
    FOLDER.mkdir(exist_ok=True)
    for name in names or GOLDEN:
        picture = GOLDEN[name].draw(None)
        was = kept(name) if (FOLDER / f"{name}.png").exists() else None
        path = keep(name, picture)
        line = f"{path.name}: {path.stat().st_size / 1e3:.0f} kB"
        if was is not None and was.shape == picture.shape:
            share, mean = difference(picture, was)
            line += f", {share:.2%} of the pixels have changed, by {mean:.2f} of 255 on average"
        print(line)
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
