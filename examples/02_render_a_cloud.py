"""Draw points from any program as water.

``python examples/02_render_a_cloud.py [cloud.npy [radius]]``: the file holds an array of shape
(n, 3) in meters, and the picture is written beside it. Without a file a torus is drawn.
"""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np
import numpy.typing as npt

import pbfluids as pbf
from pbfluids import png


def torus(count: int = 40_000) -> npt.NDArray[np.float32]:
    """Points that fill a torus of radii 0.5 m and 0.2 m."""
    x = np.random.default_rng(1).uniform(-0.7, 0.7, (8 * count, 3))
    ring = np.hypot(x[:, 0], x[:, 2]) - 0.5
    return x[np.hypot(ring, x[:, 1]) < 0.2][:count].astype(np.float32)


def main(points: npt.NDArray[np.float32], picture: Path, radius: float | None) -> None:
    lower, upper = points.min(axis=0), points.max(axis=0)
    middle, reach = (lower + upper) / 2, float(np.linalg.norm(upper - lower))
    if radius is None:  # as if the points filled a third of the box around them
        radius = float((np.prod(upper - lower) / 3 / len(points)) ** (1 / 3))
    camera = pbf.Camera(eye=middle + reach * np.array([0.5, 0.6, 1.0]), target=middle)
    with pbf.Renderer(1280, 720) as renderer:
        image = renderer.render(points, camera, pbf.RenderParams(radius=radius))
    picture.write_bytes(png.encode(image))
    print(picture)


if __name__ == "__main__":
    file = Path(sys.argv[1]) if len(sys.argv) > 1 else None
    main(
        np.load(file) if file else torus(),
        file.with_suffix(".png") if file else Path("torus.png"),
        float(sys.argv[2]) if len(sys.argv) > 2 else None,
    )
