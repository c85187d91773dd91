"""Write the pictures of docs/gallery.md: ``python examples/gallery.py [--out DIR] [NAME ...]``.

Each function below is one picture, and its first line of text says what there is to see. States of
simulations are kept in out/gallery, so that drawing again takes seconds.
"""

from __future__ import annotations

import argparse
import hashlib
import sys
from collections.abc import Callable, Sequence
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
Light = npt.NDArray[np.float32]


def state_of(scene: pbf.Scene, time: float) -> State:
    """Simulate a scene up to a time [s], or remember having done so."""
    frame_count = 1 + round(time * scene.frame_rate)
    solved = {k: v for k, v in scene.as_dict().items() if k not in ("camera", "render", "meshes")}
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


def draw(
    scene: pbf.Scene,
    state: State,
    size: tuple[int, int] = SIZE,
    *,
    meshes: Sequence[pbf.Mesh] = (),
    light: Light | None = None,
) -> Image:
    """Draw a state as its scene says."""
    with pbf.Renderer(*size, environment_map=light) as renderer:
        return renderer.render(
            state["positions"],
            scene.camera,
            scene.render_params,
            meshes=meshes,
            values=scene.values(state),
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
    return draw(scene, state_of(scene, 0.15))


def speed() -> Image:
    """Show the speed of a dam break, on the fluid and on the particles themselves."""
    scene = pbf.Scene.builtin("dam_break", color_by="speed", color_range=[0.0, 4.0])
    state = state_of(scene, 0.5)
    # The tank on the left of each half leaves room for the legend.
    camera = {"target": [1.2, 0.45, 0.25], "eye": [1.9, 1.3, 4.2], "fov_y": 30}
    scene = scene.replace(camera=camera, supersampling=2)
    half = (SIZE[0] // 2, 480)
    return beside(
        draw(scene.replace(legend=""), state, half),
        draw(scene.replace(style="spheres"), state, half),
    )


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
    camera = {"eye": [1.8, 1.0, 1.15], "target": [1.5, 0.93, 0.25], "fov_y": 22.0}
    return draw(scene.replace(camera=camera, supersampling=2), state_of(scene, 0.7))


def liquids() -> Image:
    """Show what absorption and scattered light make of the same splash: water, milk, honey, ink."""
    scene = pbf.Scene.load(SCENES / "crown.toml")
    state = state_of(scene, 0.075)
    camera = {"eye": [0.62, 0.42, 0.98], "target": [0.3, 0.085, 0.3], "fov_y": 30.0}
    looks = [
        {},
        {"absorption": [500.0, 520.0, 620.0], "scatter": [0.80, 0.78, 0.72]},
        {"absorption": [1.5, 11.0, 80.0], "scatter": [0.42, 0.15, 0.004], "refractive_index": 1.49},
        {"absorption": [220.0, 150.0, 70.0], "scatter": [0.004, 0.008, 0.05]},
    ]
    part = (SIZE[0] // 2 - 2, SIZE[1] // 2 - 2)
    water, milk, honey, ink = (
        draw(scene.replace(camera=camera, render=look), state, part) for look in looks
    )
    rows = beside(water, milk), beside(honey, ink)
    return beside(*(row.transpose(1, 0, 2) for row in rows)).transpose(1, 0, 2)


def smoothing() -> Image:
    """Show a detail as spheres make it, and smoothed by each filter."""
    scene = pbf.Scene.load(SCENES / "collision.toml").replace(render=STUDIO)
    scene = scene.replace(
        camera={"eye": [0.75, 0.35, 1.2], "target": [0.0, 0.06, 0.0], "fov_y": 14}
    )
    state = state_of(scene, 0.1)
    looks = [
        {"smoothing_iterations": 0},
        *(
            {"smoothing": name}
            for name in ("gaussian", "bilateral", "narrow_range", "curvature_flow")
        ),
    ]
    part = (SIZE[0] // 5 - 3, 480)
    return beside(
        *(draw(scene.replace(render=look), state, part, light=softboxes()) for look in looks)
    )


def paper() -> Image:
    """Show a splash over white, as it would stand in a paper."""
    scene = pbf.Scene.load(SCENES / "crown.toml")
    juice = {"absorption": [6.0, 40.0, 190.0], "scatter": [0.75, 0.24, 0.01]}
    look = {"background": "transparent", "reflection": "sky", "floor": False}
    # From before the front: a side that is seen flat mirrors the sky, not the juice.
    scene = scene.replace(camera={"eye": [0.5, 0.45, 1.28]}, render=juice | look)
    image = draw(scene, state_of(scene, 0.075))
    alpha = image[..., 3:] / 255
    return np.rint(alpha * image + (1 - alpha) * 255).astype(np.uint8)


def knot() -> Image:
    """Show a knot that stands in a pool: before, in and behind the water, and its shadow."""
    scene = pbf.Scene.load(SCENES / "pond.toml")
    t = np.linspace(0, 2 * np.pi, 720, endpoint=False)
    axis = np.stack([np.sin(t) + 2 * np.sin(2 * t), np.cos(t) - 2 * np.cos(2 * t), -np.sin(3 * t)])
    mesh = tube([0.46, 0.122, 0.3] + 0.036 * axis.T, radius=0.022, color=(0.7, 0.2, 0.05))
    return draw(scene, state_of(scene, 0.3), meshes=[mesh])


def tube(axis: npt.NDArray[np.float64], radius: float, color: tuple[float, ...]) -> pbf.Mesh:
    """Make a closed tube around a closed line of points."""
    count, sides = len(axis), 120
    along = np.roll(axis, -1, axis=0) - np.roll(axis, 1, axis=0)
    along /= np.linalg.norm(along, axis=1, keepdims=True)
    out = axis - axis.mean(axis=0)  # any direction that is not along the line
    out -= (out * along).sum(axis=1, keepdims=True) * along
    out /= np.linalg.norm(out, axis=1, keepdims=True)
    angle = 2 * np.pi * np.arange(sides)[:, None] / sides
    ring = out[:, None] * np.cos(angle) + np.cross(along, out)[:, None] * np.sin(angle)
    points = axis[:, None] + radius * ring
    i, j = np.meshgrid(np.arange(count), np.arange(sides), indexing="ij")
    i1, j1 = (i + 1) % count, (j + 1) % sides
    a, b, c, d = (u * sides + v for u, v in [(i, j), (i1, j), (i1, j1), (i, j1)])
    faces = np.stack([a, c, b, a, d, c], axis=-1).reshape(-1, 3)
    return pbf.Mesh(points.reshape(-1, 3), faces, color)


def studio() -> Image:
    """Show two drops as they meet, in the light of a studio: softboxes and a small bright sun."""
    scene = pbf.Scene.load(SCENES / "collision.toml").replace(render=STUDIO)
    scene = scene.replace(camera={"eye": [0.75, 0.35, 1.2], "fov_y": 26.0})
    return draw(scene, state_of(scene, 0.1), light=softboxes())


STUDIO = {
    "color_by": None,
    "color_range": None,
    "background": "map",
    "reflection": "map",
    "absorption": [1.5, 0.7, 0.4],
}


def softboxes(height: int = 512) -> Light:
    """Make the light: a dim room with warm and cold softboxes, and a sun 1000 times white."""
    elevation = np.pi * (0.5 - (np.arange(height)[:, None] + 0.5) / height)
    azimuth = np.pi * ((np.arange(2 * height)[None] + 0.5) / height - 1)  # 0 ahead, right above 0
    room = np.interp(elevation, [-1.6, -0.3, 0.02, 0.5, 1.6], [0.08, 0.16, 0.75, 0.3, 0.1])
    light = room[..., None] * np.ones((height, 2 * height, 3)) * (0.9, 1.0, 1.15)

    def box(at: tuple[float, float], half: tuple[float, float], color: tuple[float, ...]) -> None:
        """Add a lamp at (azimuth, elevation), with edges a little soft [degrees]."""
        turn = (np.degrees(azimuth) - at[0] + 180) % 360 - 180
        edge = np.maximum(np.abs(turn) - half[0], np.abs(np.degrees(elevation) - at[1]) - half[1])
        light[...] += np.clip(0.5 - edge / 2, 0, 1)[..., None] * color

    box((105, 42), (24, 14), (40.0, 35.0, 28.0))
    box((-150, 25), (8, 24), (14.0, 20.0, 30.0))
    box((20, 62), (60, 6), (16.0, 16.0, 16.0))
    box((150, 50), (1.5, 1.5), (1000.0, 900.0, 800.0))
    return light.astype(np.float32)


def vtk() -> Image:
    """Show the same particles from the same camera, drawn by VTK's fluid mapper and here."""
    sys.path.insert(0, str(ROOT / "bench" / "python"))
    from vs_vtk import Case, our_drawer, vtk_drawer

    scene = pbf.Scene.builtin("dam_break", spacing=0.015)
    positions = state_of(scene, 0.9)["positions"]
    case = Case("", scene.fluid.spacing, "720p")
    parts = []
    for drawing, read in (vtk_drawer(case), our_drawer(case, as_it_comes=True)):
        drawing(positions)
        alpha = np.full((SIZE[1], SIZE[0], 1), 255, np.uint8)
        image = np.concatenate([read()[..., :3], alpha], axis=2)
        parts.append(image[:, 400:1040])  # where the fluid is
    return beside(*parts)


PICTURES: list[Callable[[], Image]] = [
    *(dam_break, double_dam_break, crown, collision, speed, pressure, taylor_green),
    *(drops, liquids, smoothing, paper, knot, studio, vtk),
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
            try:
                file.write_bytes(png.encode(known[name]()[..., :3]))
                note = f"{file} {file.stat().st_size / 1e3:.0f} kB"
            except ModuleNotFoundError as error:
                note = f"{name} left out: pip install {error.name}"
            progress.update(done, len(chosen), note)


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("names", nargs="*", metavar="NAME")
    parser.add_argument("--out", type=Path, default=ROOT / "docs" / "images" / "gallery")
    arguments = parser.parse_args()
    main(arguments.names, arguments.out)
