"""One look for the plots of the docs. matplotlib is imported when something is drawn."""

from __future__ import annotations

import argparse
import json
from collections.abc import Callable
from io import BytesIO
from pathlib import Path
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure


def results_of(
    doc: str | None, name: str, measure: Callable[[], dict[str, Any]]
) -> tuple[dict[str, Any], Path]:
    """Do what the command line asks for; return what was measured and where its plots go."""
    parser = argparse.ArgumentParser(description=doc, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("--json", type=Path, default=Path(f"out/{name}.json"))
    parser.add_argument("--images", type=Path, default=Path(f"docs/images/{name}"))
    parser.add_argument("--again", action="store_true", help="draw what the JSON has")
    options = parser.parse_args()
    if not options.again:
        options.json.parent.mkdir(parents=True, exist_ok=True)
        options.json.write_text(json.dumps(measure(), indent=1), encoding="utf-8")
    return json.loads(options.json.read_text(encoding="utf-8")), options.images


def panels(count: int, height: float = 3.6) -> tuple[Figure, list[Axes]]:
    """Make a row of panels."""
    import matplotlib as mpl

    mpl.use("agg")
    import matplotlib.pyplot as plt

    figure, axes = plt.subplots(1, count, figsize=(4.3 * count, height), squeeze=False)
    for axis in axes[0]:
        axis.grid(visible=True, alpha=0.3)
        axis.spines[["top", "right"]].set_visible(False)
    return figure, list(axes[0])


def legend_below(figure: Figure, axis: Axes, columns: int) -> None:
    """Give all panels the legend of one, under them."""
    figure.legend(
        *axis.get_legend_handles_labels(),
        loc="upper center",
        bbox_to_anchor=(0.5, 0.0),
        ncols=columns,
        frameon=False,
        fontsize="small",
    )


def save(figure: Figure, path: Path) -> None:
    """Write a PNG small enough for a repository: 256 colors are enough for lines."""
    import matplotlib.pyplot as plt
    from PIL import Image

    path.parent.mkdir(parents=True, exist_ok=True)
    figure.tight_layout()
    pixels = BytesIO()
    figure.savefig(pixels, dpi=90, bbox_inches="tight")
    plt.close(figure)
    with Image.open(pixels) as image:
        image.convert("RGB").quantize(256).save(path, optimize=True)
