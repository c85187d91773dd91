"""Write the pictures of docs/gallery.md: ``python examples/gallery.py [--out DIR] [NAME ...]``.

Each function below is one picture, and its first line of text says what there is to see. States of
simulations are kept in out/gallery, so that drawing again takes seconds.
"""

from __future__ import annotations

import argparse
import hashlib
import sys
from collections.abc import Callable
from pathlib import Path

import numpy as np
import numpy.typing as npt

import pbfluids as pbf
from pbfluids import png
from pbfluids.progress import Progress

ROOT = Path(__file__).resolve().parent.parent
SCENES = ROOT / "examples" / "scenes"
CACHE = ROOT / "out" / "gallery"
SIZE = (1280, 720)

State = dict[str, npt.NDArray[np.float32]]
Image = npt.NDArray[np.uint8]


def state_of(scene: pbf.Scene, time: float) -> State:
    """Simulate a scene up to a time [s], or remember having done so."""
    frame_count = 1 + round(time * scene.frame_rate)
    solved = {k: v for k, v in scene.as_dict().items() if k not in ("camera", "render")}
    key = hashlib.sha256(f"{pbf.__version__} {solved} {frame_count}".encode()).hexdigest()[:16]
    file = CACHE / f"{scene.name}_{key}.npz"
    if not file.exists():
        with Progress(scene.name) as progress:
            *_, frame = scene.frames(frame_count, progress=progress.update, fields=["pressure"])
        file.parent.mkdir(parents=True, exist_ok=True)
        np.savez(
            file,
            positions=frame.positions,
            velocities=frame.velocities,
            pressures=frame.pressures,
            ids=frame.ids,
        )
    with np.load(file) as arrays:
        return dict(arrays)


def draw(scene: pbf.Scene, state: State, size: tuple[int, int] = SIZE) -> Image:
    """Draw a state as its scene says."""
    with pbf.Renderer(*size) as renderer:
        return renderer.render(
            state["positions"], scene.camera, scene.render_params, values=scene.values(state)
        )


def beside(*images: Image) -> Image:
    """Put pictures side by side, with a white line between them."""
    line = np.full((images[0].shape[0], 4, 4), 255, np.uint8)
    parts = [part for image in images for part in (image, line)]
    return np.concatenate(parts[:-1], axis=1)


def dam_break() -> Image:
    """Show a column of water that has collapsed and runs up the far wall."""
    scene = pbf.Scene.builtin("dam_break", spacing=0.015)
    return draw(scene, state_of(scene, 0.9))


def double_dam_break() -> Image:
    """Show the sheet that two columns throw up where they meet."""
    scene = pbf.Scene.builtin("double_dam_break", spacing=0.015)
    return draw(scene, state_of(scene, 0.7))


def crown() -> Image:
    """Show the crown around a drop that falls into a shallow pool."""
    scene = pbf.Scene.load(SCENES / "crown.toml")
    return draw(scene, state_of(scene, 0.075))


def collision() -> Image:
    """Show two drops that have met off center, without gravity."""
    scene = pbf.Scene.load(SCENES / "collision.toml")
    return draw(scene, state_of(scene, 0.3))


def speed() -> Image:
    """Show the speed of a dam break, on the fluid and on the particles themselves."""
    scene = pbf.Scene.builtin("dam_break", color_by="speed")
    camera = {"target": [1.2, 0.42, 0.25], "eye": [1.9, 1.15, 2.8], "fov_y": 62.0}
    state = state_of(scene, 0.5)
    fluid = scene.replace(camera=camera, legend="")
    spheres = scene.replace(camera=camera, style="spheres", color_range=[0.0, 4.0])
    fluid = fluid.replace(color_range=[0.0, 4.0])
    half = (SIZE[0] // 2, SIZE[1])
    return beside(draw(fluid, state, half), draw(spheres, state, half))


def pressure() -> Image:
    """Show the pressure in a tank at rest: no more than the weight of what is above."""
    scene = pbf.Scene.load(SCENES / "pressure.toml")
    return draw(scene, state_of(scene, 1.0))


def taylor_green() -> Image:
    """Show Taylor and Green's vortices in a periodic plane, by speed and by where they began."""
    spacing, loose = 0.016, 0.98
    box = pbf.Box((0, 0, 0), (1, 1, 0.1), periodic=(True, True, False))
    count = round(loose / spacing)
    grid = (np.arange(count) + 0.5) / count
    x, y = (axis.ravel() for axis in np.meshgrid(grid, grid))
    velocities = np.stack(
        [
            -np.cos(2 * np.pi * x) * np.sin(2 * np.pi * y),
            np.sin(2 * np.pi * x) * np.cos(2 * np.pi * y),
            0 * x,
        ],
        axis=1,
    )
    fluid = pbf.FluidParams(spacing=spacing, dimensions=2, gravity=(0, 0, 0))
    sim = pbf.Simulation(fluid, domain=box)
    sim.add_particles(np.stack([x, y, 0 * x], axis=1), velocities)
    with Progress("taylor_green") as progress:
        sim.advance(1 / 400, frames=120, progress=progress.update)
    view = pbf.Camera(eye=(0.5, 0.5, 1), target=(0.5, 0.5, 0), orthographic=True, height=1.03)
    with_room = view.replace(eye=(0.66, 0.5, 1), target=(0.66, 0.5, 0))  # for the legend
    params = pbf.RenderParams(
        style="spheres",
        sphere_radius=spacing / 2,
        color_range=(0, 1),
        background="plain",
        floor=False,
        sun_direction=(-0.3, 0.5, 1),
        tone_mapping="none",
        supersampling=2,
    )
    by_speed = params.replace(legend="speed [m/s]")
    by_start = params.replace(colormap="coolwarm")
    speeds = np.linalg.norm(sim.velocities, axis=1)
    with pbf.Renderer(600, 450) as wide, pbf.Renderer(450, 450) as square:
        return beside(
            wide.render(sim.positions, with_room, by_speed, values=speeds),
            square.render(sim.positions, view, by_start, values=x),
        )


def drops() -> Image:
    """Show single drops of the double dam break from near."""
    scene = pbf.Scene.builtin("double_dam_break", spacing=0.015)
    camera = {"eye": [1.25, 0.95, 1.35], "target": [1.0, 0.72, 0.25], "fov_y": 30.0}
    return draw(scene.replace(camera=camera), state_of(scene, 0.7))


def liquids() -> Image:
    """Show what absorption and scattered light make of the same splash: water, milk and juice."""
    scene = pbf.Scene.load(SCENES / "crown.toml")
    state = state_of(scene, 0.075)
    camera = {"eye": [0.5, 0.36, 0.8], "target": [0.3, 0.12, 0.3], "fov_y": 36.0}
    looks = [
        {},
        {"absorption": [120.0, 125.0, 140.0], "scatter": [0.86, 0.84, 0.78]},
        {"absorption": [6.0, 40.0, 190.0], "scatter": [0.75, 0.24, 0.01]},
    ]
    third = (SIZE[0] // 3 - 2, SIZE[1])
    return beside(
        *(draw(scene.replace(camera=camera, render=look), state, third) for look in looks)
    )


def smoothing() -> Image:
    """Show a detail as spheres make it, and smoothed in three ways."""
    scene = pbf.Scene.builtin("dam_break", spacing=0.015)
    state = state_of(scene, 0.9)
    camera = {"eye": [1.3, 0.9, 1.4], "target": [1.55, 0.35, 0.25], "fov_y": 32.0}
    looks = [
        {"smoothing_iterations": 0, "thickness_iterations": 0},
        *({"smoothing": name} for name in ("bilateral", "narrow_range", "curvature_flow")),
    ]
    part = (SIZE[0] // 4 - 3, SIZE[1])
    return beside(*(draw(scene.replace(camera=camera, render=look), state, part) for look in looks))


def paper() -> Image:
    """Show a splash over white, as it would stand in a paper."""
    scene = pbf.Scene.load(SCENES / "crown.toml")
    juice = {"absorption": [6.0, 40.0, 190.0], "scatter": [0.75, 0.24, 0.01]}
    look = {"background": "transparent", "reflection": "sky", "floor": False}
    image = draw(scene.replace(render=juice | look), state_of(scene, 0.075))
    alpha = image[..., 3:] / 255
    return np.rint(alpha * image + (1 - alpha) * 255).astype(np.uint8)


PICTURES: list[Callable[[], Image]] = [
    *(dam_break, double_dam_break, crown, collision, speed, pressure, taylor_green),
    *(drops, liquids, smoothing, paper),
]


def main(names: list[str], directory: Path) -> None:
    """Write the pictures of these names, or all."""
    known = {picture.__name__: picture for picture in PICTURES}
    if unknown := set(names) - set(known):
        sys.exit(f"no picture is called {', '.join(sorted(unknown))}; known: {', '.join(known)}")
    directory.mkdir(parents=True, exist_ok=True)
    chosen = names or list(known)
    with Progress("gallery") as progress:
        for done, name in enumerate(chosen, start=1):
            file = directory / f"{name}.png"
            file.write_bytes(png.encode(known[name]()[..., :3]))
            progress.update(done, len(chosen), f"{file} {file.stat().st_size / 1e3:.0f} kB")


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("names", nargs="*", metavar="NAME")
    parser.add_argument("--out", type=Path, default=ROOT / "docs" / "images" / "gallery")
    arguments = parser.parse_args()
    main(arguments.names, arguments.out)
