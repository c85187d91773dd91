"""Compare the depth filters on surfaces that have a formula; draws what docs/smoothing.md shows.

Particles fill a body on a jittered lattice. A filter is as good as the surface that its smoothed
depth and its normals stand for: how rough, how steep where it should not be, how far from the edge
of what is in front. Times are medians of turns.
"""

from __future__ import annotations

import sys
import time
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from machine import commit, processor
from plots import panels, results_of, save

import pbfluids as pbf

sys.path.insert(0, str(Path(__file__).parents[2] / "tests"))
from reference import smoothing as ref

Table = dict[str, Any]
Array = np.ndarray

D = 0.02  # particle distance [m], and radius of the sprites
FILTERS = ["bilateral", "narrow_range", "curvature_flow", "gaussian"]
WAVE, LENGTH = 0.03, 0.5  # height and length of the pool's waves [m]
BALL = np.array([0.0, 0.35, 0.3])
SIZE = (640, 480)


def params(kind: str, **fields: Any) -> pbf.RenderParams:
    return pbf.RenderParams(radius=D, particle_volume=D**3, smoothing=kind, **fields)


def jittered(lower: tuple[float, ...], upper: tuple[float, ...]) -> Array:
    """Fluid is no lattice: shaken by a fifth of the distance."""
    x = pbf.block(lower, upper, spacing=D)
    return x + np.random.default_rng(1).uniform(-0.2 * D, 0.2 * D, x.shape)


def wave(x: Array) -> Array:
    """Height of the pool's surface [m]."""
    return WAVE * np.sin(2 * np.pi * x[..., 0] / LENGTH) * np.cos(2 * np.pi * x[..., 2] / LENGTH)


def wave_normal(x: Array) -> Array:
    k = 2 * np.pi / LENGTH
    a, b = k * x[..., 0], k * x[..., 2]
    slopes = WAVE * k * np.stack([np.cos(a) * np.cos(b), -np.sin(a) * np.sin(b)], axis=-1)
    n = np.stack([-slopes[..., 0], np.ones_like(a), -slopes[..., 1]], axis=-1)
    return n / np.linalg.norm(n, axis=-1, keepdims=True)


@dataclass(frozen=True)
class Surface:
    """A body of particles, where a point is above its surface [m], and the surface's normal."""

    particles: Array
    height: Callable[[Array], Array]
    normal: Callable[[Array], Array]
    inside: Callable[[Array], Array]  # points that count: not at the body's other faces


def pool() -> Surface:
    x = jittered((-1.0, -0.2, -1.0), (1.0, WAVE + D, 1.0))
    return Surface(
        x[x[:, 1] < wave(x) - D / 2],
        lambda p: p[..., 1] - wave(p),
        wave_normal,
        lambda p: np.abs(p[..., [0, 2]]).max(axis=-1) < 0.9,
    )


def ball(radius: float = 0.25) -> Surface:
    x = jittered((-0.3,) * 3, (0.3,) * 3)
    return Surface(
        x[np.linalg.norm(x, axis=1) < radius - D / 2],
        lambda p: np.linalg.norm(p, axis=-1) - radius,
        lambda p: p / np.linalg.norm(p, axis=-1, keepdims=True),
        lambda p: np.linalg.norm(p, axis=-1) < 2 * radius,
    )


def ball_over_pool() -> Surface:
    """A ball in front of the pool: which of the two a point belongs to is that which is nearer."""
    low, high = pool(), ball(0.12)
    center = BALL

    def of_ball(p: Array) -> Array:
        return np.abs(high.height(p - center) * 2 + 0.13) < np.abs(low.height(p))

    return Surface(
        np.concatenate([low.particles, high.particles + center]),
        lambda p: np.where(of_ball(p), high.height(p - center), low.height(p)),
        lambda p: np.where(of_ball(p)[..., None], high.normal(p - center), low.normal(p)),
        low.inside,
    )


def camera(fov: float | None = 45, distance: float = 1.6) -> pbf.Camera:
    """Look down on the origin from so far away that it fills the picture at any field of view."""
    half = np.tan(np.radians((fov or 45) / 2))
    eye = np.array([0.35, 0.6, 0.72]) * distance * np.tan(np.radians(22.5)) / half
    lens = {"fov_y": fov} if fov else {"orthographic": True, "height": 1.3}
    return pbf.Camera(eye=tuple(eye), target=(0, 0, 0), **lens)


def frame_of(view: pbf.Camera) -> Array:
    """Columns: right, up and backwards in the world."""
    z = np.array(view.eye) - np.array(view.target)
    z /= np.linalg.norm(z)
    x = np.cross((0, 1, 0), z)
    x /= np.linalg.norm(x)
    return np.stack([x, np.cross(z, x), z], axis=1)


def half_height(view: pbf.Camera) -> float:
    return 0.5 * view.height if view.orthographic else float(np.tan(np.radians(view.fov_y) / 2))


def world(depth: Array, view: pbf.Camera) -> Array:
    """Points of the world that pixels of a depth show."""
    height, width = depth.shape
    half = half_height(view)
    x = (2 * (np.arange(width) + 0.5) / width - 1) * half * width / height
    y = -(2 * (np.arange(height) + 0.5) / height - 1) * half
    slope_x, slope_y = np.meshgrid(x, y)
    spread = 1 if view.orthographic else depth
    eye = np.stack([slope_x * spread, slope_y * spread, -depth], axis=-1)
    return np.array(view.eye) + eye @ frame_of(view).T


def errors(layers: dict[str, Array], surface: Surface, view: pbf.Camera) -> Table:
    """Height over the true surface: offset, roughness [D]; angle of the normals [degrees]."""
    depth = layers["depth_smooth"].astype(float)
    at = world(depth, view)
    raw = layers["depth"].astype(float)
    seen = (raw > 0) & surface.inside(world(raw, view))
    rows, columns = np.indices(depth.shape)
    seen &= (np.minimum(rows, rows[::-1]) > 4) & (np.minimum(columns, columns[:, ::-1]) > 4)
    height = surface.height(at)[seen] / D
    offset = float(np.median(height))
    normals = layers["normal"].astype(float) @ frame_of(view).T
    cosine = np.sum(normals * surface.normal(at), axis=-1)[seen]
    angle = np.degrees(np.arccos(np.clip(cosine, -1, 1)))
    return {
        "offset": offset,
        "rough": float(np.mean(np.abs(height - offset))),
        "angle": float(np.mean(angle)),
        "angle_95": float(np.percentile(angle, 95)),
        "pixels": int(seen.sum()),
    }


SURFACES = {"wavy pool": pool, "ball": ball, "ball over pool": ball_over_pool}
ERROR_CASES: list[tuple[str, float | None]] = [
    *((name, 45.0) for name in SURFACES),
    *(("wavy pool", fov) for fov in (20.0, 90.0, None)),
]


def accuracy() -> Table:
    """Errors of each filter on each surface, and without any."""
    rows: Table = {}
    with pbf.Renderer(*SIZE) as renderer:
        for name, fov in ERROR_CASES:
            surface, view = SURFACES[name](), camera(fov)
            label = f"{name}, {f'{fov:g}°' if fov else 'parallel'}"
            rows[label] = {}
            for kind in ["none", *FILTERS]:
                fields = {"smoothing_iterations": 0} if kind == "none" else {}
                chosen = params("bilateral" if kind == "none" else kind, **fields)
                layers = renderer.layers(surface.particles, view, chosen)
                rows[label][kind] = errors(layers, surface, view)
    return rows


def outlines() -> Table:
    """Angle of the normals' errors [degrees] by pixels from a ball's outline, in a sprite's width.

    By differences alone, as where no drop_radius tells bodies from drops, and as they are.
    """
    rows: Table = {}
    for radius, distance in ((0.25, 1.6), (0.12, 1.6), (0.12, 0.7)):
        surface, view = ball(radius), camera(45, distance)
        row: Table = {}
        for name, drop_radius in (("differences", None), ("rim", 0.62 * D)):
            with pbf.Renderer(*SIZE) as renderer:
                chosen = params("bilateral", drop_radius=drop_radius)
                layers = renderer.layers(surface.particles, view, chosen)
            ways = [0, 1, 2, 4, 8]
            inside = [within(layers["depth"] > 0, way) for way in ways]
            angle = angle_to_ball(layers["normal"].astype(float), inside[0], view)
            row[name] = {
                str(way): float(np.mean(angle[outer & ~inner]))
                for way, outer, inner in zip(ways[1:], inside[:-1], inside[1:], strict=True)
            }
        pixels = D * SIZE[1] / (2 * half_height(view) * np.linalg.norm(view.eye))
        rows[f"{radius:g} m, sprites of {pixels:.0f} pixels"] = row
    return rows


def within(fluid: Array, way: int) -> Array:
    """Pixels that are farther than a number of pixels from where there is no fluid."""
    for _ in range(way):
        around = [np.roll(fluid, (x, y), (0, 1)) for x in (-1, 0, 1) for y in (-1, 0, 1)]
        fluid = np.logical_and.reduce(around)
    return fluid


def angle_to_ball(normals: Array, fluid: Array, view: pbf.Camera) -> Array:
    """Angle to the normals of the ball around the origin that has the fluid's outline [degrees]."""
    eye = np.array(view.eye)
    rays = world(np.ones_like(normals[..., 0]), view) - eye
    rays /= np.linalg.norm(rays, axis=-1, keepdims=True)
    nearest = eye - (rays @ eye)[..., None] * rays
    miss = np.linalg.norm(nearest, axis=-1)
    radius = np.percentile(miss[fluid], 99.9)
    half_chord = np.sqrt(np.maximum(radius**2 - miss**2, 0))
    truth = nearest - half_chord[..., None] * rays
    truth /= np.linalg.norm(truth, axis=-1, keepdims=True)
    cosine = np.sum(normals @ frame_of(view).T * truth, axis=-1)
    return np.degrees(np.arccos(np.clip(cosine, -1, 1)))


def resolutions() -> Table:
    """Errors on the pool by the height of the picture: the same, if lengths are in the world."""
    surface, view = pool(), camera()
    rows: Table = {}
    for height in (240, 480, 960):
        with pbf.Renderer(height * 4 // 3, height) as renderer:
            rows[str(height)] = {
                kind: errors(renderer.layers(surface.particles, view, params(kind)), surface, view)
                for kind in FILTERS
            }
    return rows


def iterations() -> Table:
    """Roughness and angle by the number of iterations, bilateral and curvature flow."""
    surface, view = pool(), camera()
    rows: Table = {kind: {} for kind in FILTERS}
    with pbf.Renderer(*SIZE) as renderer:
        for kind in FILTERS:
            for count in (1, 2, 3, 4, 6):
                chosen = params(kind, smoothing_iterations=count)
                layers = renderer.layers(surface.particles, view, chosen)
                rows[kind][str(count)] = errors(layers, surface, view)
    return rows


def shapes() -> Table:
    """Errors with spheres and with ellipsoids, without any filter and after it."""
    view = camera()
    rows: Table = {}
    with pbf.Renderer(*SIZE) as renderer:
        for name, of in SURFACES.items():
            surface = of()
            rows[name] = {}
            for anisotropy in (0.0, 1.0):
                for count in (0, 1, 2):
                    chosen = params("bilateral", anisotropy=anisotropy, smoothing_iterations=count)
                    layers = renderer.layers(surface.particles, view, chosen)
                    rows[name][f"{anisotropy:g}/{count}"] = errors(layers, surface, view)
    return rows


def times(turns: int = 7) -> Table:
    """Milliseconds that the processors work on the filter at 1280 x 720, in turns.

    By the difference to a picture without: time by the clock would be that of a busy machine.
    """
    surface, view = ball_over_pool(), camera()
    found: dict[str, list[float]] = {kind: [] for kind in FILTERS}
    with pbf.Renderer(1280, 720) as renderer:

        def spent(chosen: pbf.RenderParams) -> float:
            start = time.process_time()
            renderer.render(surface.particles, view, chosen)
            return 1e3 * (time.process_time() - start)

        for _ in range(turns):
            without = spent(params("bilateral", smoothing_iterations=0))
            for kind in FILTERS:
                found[kind].append(spent(params(kind)) - without)
        depth = renderer.layers(surface.particles, view, params("bilateral"))["depth"]
    return {
        "milliseconds": {kind: float(np.median(ms)) for kind, ms in found.items()},
        "fluid": float(np.mean(depth > 0)),
        "particles": len(surface.particles),
    }


def separation() -> Table:
    """The separable form against the true filter in two dimensions, in NumPy, on part of a picture.

    With and without a further true pass of 5 x 5 pixels.
    """
    scene, view = ball_over_pool(), camera()
    with pbf.Renderer(*SIZE) as renderer:
        depth = renderer.layers(scene.particles, view, params("bilateral"))["depth"]
    lens = ref.View(*SIZE, half_height(view))
    column, row = (int(n) for n in on_picture(BALL - (0.1, 0.05, 0), view))
    size = 70
    part = depth[row - size : row + size, column - size : column + size]
    a = lens.affine(part[::-1].astype(float))
    rows: Table = {}
    for kind in ("bilateral", "narrow_range", "gaussian"):

        def true(v: Array, pixels: float | None = None, kind: str = kind) -> Array:
            radius = 2 * D * lens.scale(v) if pixels is None else 0 * v + pixels
            return ref.smooth_plane(v, radius, ref.depth_window(v, lens, 4 * D, D), kind)

        expected = true(true(a))
        separate = a
        for _ in range(2):
            separate = ref.smooth_depth(separate, lens, kind, 2 * D, 4 * D, D)
        rows[kind] = {}
        for name, value in (("none", a), ("separable", separate), ("5 x 5", true(separate, 2.5))):
            error = np.abs(lens.depth(value) - lens.depth(expected))[~np.isnan(a)] / D
            rows[kind][name] = {"mean": float(error.mean()), "99": float(np.percentile(error, 99))}
    return rows


def on_picture(point: Array, view: pbf.Camera) -> Array:
    """Column and row of a point."""
    x, y, z = (point - np.array(view.eye)) @ frame_of(view)
    half = half_height(view)
    width, height = SIZE
    return np.array(
        [(x / -z / half * height / width + 1) * width / 2, (1 - y / -z / half) * height / 2]
    )


def measure() -> Table:
    start = time.perf_counter()
    results: Table = {"commit": commit(), "processor": processor()}
    for part in (times, accuracy, outlines, shapes, resolutions, iterations, separation):
        results[part.__name__] = part()
        print(f"{time.perf_counter() - start:6.0f} s  {part.__name__}", flush=True)
    return results


def draw_pictures(folder: Path) -> None:
    """The four filters side by side: pictures, and slopes of the ball's and the pool's surface."""
    surface, view = ball_over_pool(), camera(30, 1.2)
    figure, axes = panels(len(FILTERS), 3.3)
    with pbf.Renderer(480, 360) as renderer:
        for axis, kind in zip(axes, FILTERS, strict=True):
            axis.imshow(renderer.render(surface.particles, view, params(kind)))
            axis.set(title=kind)
            axis.axis("off")
    save(figure, folder / "filters.png")


def draw_shapes(folder: Path) -> None:
    """A breaking wave from near, of spheres and of ellipsoids."""
    scene = pbf.Scene.builtin("dam_break")
    *_, frame = scene.frames(79)
    view = pbf.Camera(eye=(1.6, 0.6, 1.0), target=(1.05, 0.25, 0.2), fov_y=40)
    chosen = scene.render_params
    figure, axes = panels(2)
    figure.set_size_inches(17, 5)
    with pbf.Renderer(1280, 720) as renderer:
        for axis, anisotropy in zip(axes, (0.0, 1.0), strict=True):
            chosen.anisotropy = anisotropy
            axis.imshow(renderer.render(frame.positions, view, chosen))
            axis.set(title=f"anisotropy = {anisotropy:g}")
            axis.axis("off")
    save(figure, folder / "ellipsoids.png")


def draw_normals(folder: Path) -> None:
    """Angle between the normal and that of the true surface."""
    surface, view = ball_over_pool(), camera()
    figure, axes = panels(len(FILTERS), 3.3)
    with pbf.Renderer(*SIZE) as renderer:
        for axis, kind in zip(axes, FILTERS, strict=True):
            layers = renderer.layers(surface.particles, view, params(kind))
            at = world(layers["depth_smooth"].astype(float), view)
            normals = layers["normal"].astype(float) @ frame_of(view).T
            cosine = np.clip(np.sum(normals * surface.normal(at), axis=-1), -1, 1)
            angle = np.where(layers["depth"] > 0, np.degrees(np.arccos(cosine)), np.nan)
            axis.imshow(angle[60:420, 80:560], vmin=0, vmax=30, cmap="magma")
            axis.set(title=kind)
            axis.axis("off")
    save(figure, folder / "normals.png")


def draw_errors(results: Table, folder: Path) -> None:
    figure, (left, middle, right) = panels(3)
    for kind in FILTERS:
        dashes = "--" if kind == "gaussian" else "-"
        row = results["iterations"][kind]
        counts = [int(n) for n in row]
        left.plot(counts, [row[n]["angle"] for n in row], marker="o", ls=dashes, label=kind)
        middle.plot(counts, [row[n]["rough"] for n in row], marker="o", ls=dashes, label=kind)
        heights = results["resolutions"]
        right.semilogx(
            [int(h) for h in heights],
            [heights[h][kind]["angle"] for h in heights],
            marker="o",
            ls=dashes,
        )
    left.set(
        xlabel="iterations", ylabel="mean angle of the normals' error [degrees]", ylim=(0, None)
    )
    middle.set(xlabel="iterations", ylabel="roughness [particle distances]", ylim=(0, None))
    right.set(
        xlabel="height of the picture [pixels]", ylabel="mean angle [degrees]", ylim=(0, None)
    )
    right.set_xticks([240, 480, 960], ["240", "480", "960"])
    right.minorticks_off()
    left.legend(fontsize="small")
    save(figure, folder / "errors.png")


def summary(results: Table) -> str:
    """The tables of the page."""
    lines = ["| surface, camera | " + " | ".join(["none", *FILTERS]) + " |"]
    lines.append("|" + "---|" * (len(FILTERS) + 2))
    for label, row in results["accuracy"].items():
        cells = [f"{row[k]['angle']:.1f}° / {row[k]['rough']:.3f}" for k in ["none", *FILTERS]]
        lines.append(f"| {label} | " + " | ".join(cells) + " |")
    lines += ["", "| surface, anisotropy / iterations | angle | rough | offset |"]
    lines.append("|---|---|---|---|")
    for label, row in results["shapes"].items():
        for name, error in row.items():
            numbers = f"{error['angle']:.1f}° | {error['rough']:.3f} | {error['offset']:+.2f}"
            lines.append(f"| {label}, {name} | {numbers} |")
    lines += ["", "| ball, pixels from the outline | 1 | 2 | 3-4 | 5-8 |", "|---|---|---|---|---|"]
    for label, row in results["outlines"].items():
        for name, error in row.items():
            cells = " | ".join(f"{angle:.1f}°" for angle in error.values())
            lines.append(f"| {label}, {name} | {cells} |")
    ms = results["times"]["milliseconds"]
    lines.append(
        "| processor time at 1280×720 [ms] | | "
        + " | ".join(f"{ms[k]:.1f}" for k in FILTERS)
        + " |"
    )
    lines += ["", "| filter | error left | mean | 99 % |", "|---|---|---|---|"]
    for kind, row in results["separation"].items():
        for name, error in row.items():
            lines.append(f"| {kind} | {name} | {error['mean']:.3f} | {error['99']:.2f} |")
    return "\n".join(lines)


def main() -> None:
    results, images = results_of(__doc__, "smoothing", measure)
    draw_errors(results, images)
    draw_pictures(images)
    draw_shapes(images)
    draw_normals(images)
    print(summary(results))
    print({key: results["times"][key] for key in ("fluid", "particles")})


if __name__ == "__main__":
    main()
