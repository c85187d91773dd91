"""Pictures that shall stay as they are: what each shows, and how far another driver may be off.

``python scripts/update_golden.py`` draws them again. Their particles come from formulas, so that no
change of the solver is a change of a picture.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Literal

import numpy as np
import numpy.typing as npt
from PIL import Image

import pbfluids as pbf

FOLDER = Path(__file__).resolve().parents[1] / "golden"
DIFFERENCES = Path(__file__).resolve().parents[2] / "out" / "golden"
WIDTH, HEIGHT = 224, 126
#: A pixel is off if a channel is by more than this, of 255. Rounding is 1, the encoding's slope
#: near black makes 4 of it.
LEVELS = 8

Backend = Literal["cpu", "egl"] | None
Pixels = npt.NDArray[np.uint8]

SPACING = 0.025
VIEW = pbf.Camera(eye=(1.2, 0.72, 1.3), target=(0.49, 0.13, 0.25), fov_y=30)
WATER = pbf.RenderParams(
    radius=1.2 * SPACING,
    drop_radius=0.62 * SPACING,
    sphere_radius=0.5 * SPACING,
    particle_volume=SPACING**3,
    tank_lower=(0, 0, 0),
    tank_upper=(1, 0.5, 0.5),
)


@dataclass(frozen=True)
class Golden:
    """A picture, and what another driver may make of it."""

    draw: Callable[[Backend], Pixels]
    #: Of the pixels, how many may be off.
    share: float
    #: By how much the channels may be off on average [of 255].
    mean: float
    #: Why so much, and what it still finds.
    reason: str


def scattered(count: int) -> npt.NDArray[np.float64]:
    """Points of the unit cube, evenly spread: multiples of powers of a root of x⁴ = x + 1."""
    root = 1.2207440846057596
    return np.modf(np.outer(np.arange(1, count + 1), root ** -np.arange(1.0, 4.0)))[0]


def wave() -> npt.NDArray[np.float32]:
    """Water in a tank with a crest, out of order by a third of the spacing, and drops above it."""
    axes = [np.arange(SPACING / 2, length, SPACING) for length in (1.0, 0.5, 0.5)]
    x, y, z = (axis.ravel() for axis in np.meshgrid(*axes, indexing="ij"))
    crest = 0.2 * np.exp(-(((x - 0.32) / 0.14) ** 2)) * (1 + 0.3 * np.cos(8 * z))
    body = np.stack([x, y, z], axis=1)[y < 0.13 + crest]
    body += (scattered(len(body)) - 0.5) * 0.35 * SPACING
    drops = (0.45, 0.25, 0.05) + scattered(60) * (0.45, 0.2, 0.4)
    return np.concatenate([body, drops]).astype(np.float32)


def ring(radius: float = 0.15, tube: float = 0.05) -> pbf.Mesh:
    """Make a torus that stands half in the water."""
    u, v = np.meshgrid(np.arange(48), np.arange(24), indexing="ij")
    a, b = 2 * np.pi * u / 48, 2 * np.pi * v / 24
    out = radius + tube * np.cos(b)
    points = np.stack([0.72 + out * np.cos(a), 0.16 + out * np.sin(a), 0.25 + tube * np.sin(b)], 2)
    near, right = (u * 24 + v), ((u + 1) % 48 * 24 + v)
    up = u * 24 + (v + 1) % 24
    across = (u + 1) % 48 * 24 + (v + 1) % 24
    faces = np.concatenate(
        [np.stack(t, 2).reshape(-1, 3) for t in [(near, right, across), (near, across, up)]]
    )
    return pbf.Mesh(points.reshape(-1, 3), faces, (0.75, 0.16, 0.06))


def lamps() -> npt.NDArray[np.float32]:
    """Light of a gray room with two bright lamps."""
    light = np.full((64, 128, 3), 0.25, np.float32)
    light[40:] = (0.12, 0.1, 0.09)
    light[8:22, 20:48] = (9.0, 8.0, 6.5)
    light[14:26, 78:90] = (3.0, 5.0, 9.0)
    return light


def drawn(
    backend: Backend, params: pbf.RenderParams, *, light: Any = None, **options: Any
) -> Pixels:
    """Draw the wave."""
    with pbf.Renderer(WIDTH, HEIGHT, backend=backend, environment_map=light) as renderer:
        return renderer.render(wave(), VIEW, params, **options)


def water(backend: Backend) -> Pixels:
    """Draw sky, floor, shadow, tank, drops; reflection and refraction."""
    return drawn(backend, WATER)[..., :3]


def spheres(backend: Backend) -> Pixels:
    """Draw particles by their height."""
    look = WATER.replace(style="spheres", color_range=(0, 0.4))
    return drawn(backend, look, values=wave()[:, 1])[..., :3]


def transparent(backend: Backend) -> Pixels:
    """Draw colors and alpha of a juice over nothing."""
    return drawn(
        backend,
        WATER.replace(
            background="transparent",
            floor=False,
            absorption=(3, 12, 30),
            scatter=(0.5, 0.16, 0.02),
        ),
    )


def mesh(backend: Backend) -> Pixels:
    """Draw a ring before, in and behind the fluid, with its shadow."""
    return drawn(backend, WATER, meshes=[ring()])[..., :3]


def light(backend: Backend) -> Pixels:
    """Draw lamps mirrored and bent, spread where the mirror is small."""
    look = WATER.replace(background="map", reflection="map", floor=False)
    return drawn(backend, look, light=lamps())[..., :3]


def filters(backend: Backend) -> Pixels:
    """Draw the normals behind bilateral, narrow-range, curvature-flow and Gaussian smoothing."""
    parts = []
    with pbf.Renderer(WIDTH // 2, HEIGHT // 2, backend=backend) as renderer:
        for name in ("bilateral", "narrow_range", "curvature_flow", "gaussian"):
            layers = renderer.layers(wave(), VIEW, WATER.replace(smoothing=name))
            parts.append(np.rint(127.5 * (1 + layers["normal"])).astype(np.uint8))
    return np.block([[[parts[0]], [parts[1]]], [[parts[2]], [parts[3]]]])


# What the same build makes of them: Mesa's llvmpipe by shaders instead of C++, with vectors of four
# instead of eight, is off by 0.0003 on average and nowhere by more than 2; its softpipe, which
# rasterizes and filters by code of its own, stands for other drivers in the reasons below.
GOLDEN = {
    "water": Golden(
        water,
        share=0.005,
        mean=0.3,
        reason="softpipe: none off, 0.17 on average, of the floor's tiles and its shadow. An index "
        "of refraction of 1.30 for 1.33: 1.2 %, 1.0; 5 % more absorption: 0.35 on average.",
    ),
    "spheres": Golden(
        spheres,
        share=0.01,
        mean=0.4,
        reason="softpipe: 0.4 %, 0.32, at outlines, where a pixel has one sphere or the other. "
        "Spheres 3 % larger: 2 %, 0.66; a shadow weaker by a tenth: 0.43 on average.",
    ),
    "transparent": Golden(
        transparent,
        share=0.005,
        mean=0.2,
        reason="softpipe: none off, 0.07 on average. Mirroring a tenth less: 0.58 on average; "
        "normals from one side only: 4 %, 1.3.",
    ),
    "mesh": Golden(
        mesh,
        share=0.005,
        mean=0.3,
        reason="As water: softpipe 0.01 %, 0.17, a few pixels of the ring's outline. A ray bent "
        "once instead of twice: 3 %, 0.7.",
    ),
    "light": Golden(
        light,
        share=0.005,
        mean=0.15,
        reason="softpipe: none off, 0.05 on average, of the map's mipmaps. 5 % more absorption: "
        "0.19 on average; mirroring a tenth less: 0.27.",
    ),
    "filters": Golden(
        filters,
        share=0.005,
        mean=0.1,
        reason="softpipe: none off, 0.0002 on average: layers are numbers, and drivers agree on "
        "them; the rest is for other square roots. One iteration more: 9 %, 1.6.",
    ),
}


def kept(name: str) -> Pixels:
    """Read the picture as it shall be."""
    with Image.open(FOLDER / f"{name}.png") as picture:
        return np.asarray(picture).copy()


def keep(name: str, picture: Pixels) -> Path:
    """Write the picture as it shall be."""
    path = FOLDER / f"{name}.png"
    Image.fromarray(picture).save(path, optimize=True)
    return path


def difference(found: Pixels, expected: Pixels) -> tuple[float, float]:
    """Share of pixels that are off, and how far channels are on average [of 255]."""
    apart = np.abs(found.astype(int) - expected)
    return float((apart.max(axis=2) > LEVELS).mean()), float(apart.mean())


def complaint(name: str, found: Pixels, folder: Path = DIFFERENCES) -> str | None:
    """Say how a picture differs from the one that is kept, and leave what shows it; None if not."""
    golden, expected = GOLDEN[name], kept(name)
    if found.shape != expected.shape:
        return f"{name}: has shape {found.shape}, was {expected.shape}"
    share, mean = difference(found, expected)
    if share <= golden.share and mean <= golden.mean:
        return None
    apart = np.abs(found.astype(int) - expected).max(axis=2)
    rows, columns = np.nonzero(apart > min(LEVELS, apart.max() - 1))
    magnified = np.minimum(8 * apart, 255).astype(np.uint8)
    shown = [
        *(image[..., :3] for image in (expected, found)),
        np.repeat(magnified[..., None], 3, 2),
    ]
    folder.mkdir(parents=True, exist_ok=True)
    path = folder / f"{name}.png"
    Image.fromarray(np.concatenate(shown, axis=1)).save(path)
    return (
        f"{name}: {share:.2%} of the pixels are off by more than {LEVELS} of 255 (at most "
        f"{golden.share:.2%}), channels by {mean:.2f} on average (at most {golden.mean:g}); most "
        f"at row {np.argmax(apart) // apart.shape[1]}, column {np.argmax(apart) % apart.shape[1]}, "
        f"all within rows {rows.min()} to {rows.max()}, columns {columns.min()} to "
        f"{columns.max()}. Expected, found, the difference times 8 stand side by side: {path}. "
        f"If the change is meant: python scripts/update_golden.py {name}"
    )
