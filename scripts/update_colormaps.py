"""Write cpp/pbf/render/colormap_tables.inl: ``python scripts/update_colormaps.py``.

The tables are matplotlib's, which asks for nothing: viridis and magma are in the public domain
(CC0), cividis and coolwarm under matplotlib's BSD-style license. They are committed, so that nobody
needs matplotlib to build; a test compares them where it is installed.
"""

from __future__ import annotations

import math
from pathlib import Path

import matplotlib as mpl
import numpy as np

OUTPUT = Path(__file__).resolve().parent.parent / "cpp" / "pbf" / "render" / "colormap_tables.inl"
NAMES = ["viridis", "magma", "cividis", "coolwarm", "gray"]
COLORS = 256

HEAD = """// Written by scripts/update_colormaps.py. 0xrrggbb, sRGB, least value first.
// viridis and magma: S. van der Walt, N. Smith, CC0. cividis: J. Nunez, C. Anderton, R. Renslow.
// coolwarm: K. Moreland. As in matplotlib, under its license. shuffled: by the script.
// clang-format off
"""


def listed(name: str) -> list[int]:
    """Give a map of matplotlib's."""
    colors = mpl.colormaps[name].resampled(COLORS)(np.arange(COLORS))
    return [int(r) << 16 | int(g) << 8 | int(b) for r, g, b, _ in np.rint(255 * colors)]


def shuffled() -> list[int]:
    """Give colors of which near ones differ: hues by the golden angle, three lightnesses."""
    return [
        oklch((0.58, 0.72, 0.84)[k % 3], 0.13, math.tau * (k * (math.sqrt(5) - 1) / 2 % 1))
        for k in range(COLORS)
    ]


def oklch(lightness: float, chroma: float, hue: float) -> int:
    """Turn a color of B. Ottosson's Oklab space into sRGB, with less chroma if need be."""
    a, b = chroma * math.cos(hue), chroma * math.sin(hue)
    cone = np.array(
        [
            lightness + 0.3963377774 * a + 0.2158037573 * b,
            lightness - 0.1055613458 * a - 0.0638541728 * b,
            lightness - 0.0894841775 * a - 1.2914855480 * b,
        ]
    )
    to_rgb = np.array(
        [
            [4.0767416621, -3.3077115913, 0.2309699292],
            [-1.2684380046, 2.6097574011, -0.3413193965],
            [-0.0041960863, -0.7034186147, 1.7076147010],
        ]
    )
    linear = to_rgb @ cone**3
    if linear.min() < 0 or linear.max() > 1:
        return oklch(lightness, 0.98 * chroma, hue)
    curved = np.where(linear > 0.0031308, 1.055 * linear ** (1 / 2.4) - 0.055, 12.92 * linear)
    red, green, blue = np.rint(255 * curved).astype(int).tolist()
    return int(red << 16 | green << 8 | blue)


def table(name: str, colors: list[int]) -> str:
    """Write a map as a line of C++ per eight colors."""
    words = [f"0x{color:06x}" for color in colors]
    rows = [", ".join(words[k : k + 8]) for k in range(0, COLORS, 8)]
    return f"    // {name}\n    {{\n        " + ",\n        ".join(rows) + ",\n    },\n"


def main() -> None:
    """Write the file."""
    tables = [(name, listed(name)) for name in NAMES] + [("shuffled", shuffled())]
    OUTPUT.write_text(HEAD + "".join(table(*entry) for entry in tables), encoding="utf-8")
    print(OUTPUT)


if __name__ == "__main__":
    main()
