"""The commands of ``pbfluids``. Results go to stdout, progress and errors to stderr."""

from __future__ import annotations

import json
import re
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Annotated, Any

import typer

from pbfluids import toml
from pbfluids._version import __version__
from pbfluids.cli import Interrupted
from pbfluids.errors import InvalidParameter
from pbfluids.progress import Progress
from pbfluids.scene import Scene

app = typer.Typer(
    help="Position Based Fluids: simulate, and render without a screen.",
    no_args_is_help=True,
    add_completion=False,
    pretty_exceptions_enable=False,
    context_settings={"help_option_names": ["-h", "--help"]},
)

SceneName = Annotated[
    str, typer.Argument(metavar="SCENE", help="A built-in scene, or the path of a TOML file.")
]
Set = Annotated[
    list[str] | None,
    typer.Option(
        "--set",
        metavar="KEY=VALUE",
        help="Change the scene, for example --set spacing=0.03; may be repeated.",
    ),
]
Color = Annotated[
    str | None,
    typer.Option(
        metavar="ATTRIBUTE", help="Color the particles by speed, density, pressure or id."
    ),
]
Video = Annotated[
    Path | None, typer.Option("--video", metavar="FILE.mp4", help="Write a video as well.")
]


def _print_version(wanted: bool) -> None:
    if wanted:
        print(__version__)
        raise typer.Exit


@app.callback()
def _root(
    version: Annotated[
        bool,
        typer.Option("--version", callback=_print_version, is_eager=True, help="Print it."),
    ] = False,
    debug: Annotated[
        bool, typer.Option("--debug", help="Show tracebacks; may stand anywhere.")
    ] = False,
) -> None:
    """Position Based Fluids: simulate, and render without a screen."""


@app.command()
def run(
    scene: SceneName,
    out: Annotated[
        Path | None,
        typer.Option(
            metavar="DIR", help="Where to; an earlier run there is removed.  [default: out/NAME]"
        ),
    ] = None,
    video: Video = None,
    size: Annotated[str, typer.Option(metavar="WxH", help="Size of the pictures.")] = "1280x720",
    frames: Annotated[
        int | None,
        typer.Option(metavar="N", min=1, help="How many, the initial state among them."),
    ] = None,
    threads: Annotated[
        int | None, typer.Option(metavar="N", help="0 for all; the result is the same.")
    ] = None,
    render: Annotated[
        bool, typer.Option("--render/--no-render", help="Draw pictures as it goes.")
    ] = True,
    color: Color = None,
    fields: Annotated[
        str,
        typer.Option(
            metavar="NAMES",
            help="What else to keep of particles: pressure, density, or pressure,density.",
        ),
    ] = "",
    changes: Set = None,
) -> None:
    """Simulate a scene and render it."""
    from pbfluids.run import simulate

    overrides = _assignments(changes or [])
    if threads is not None:
        overrides["solver.num_threads"] = threads
    if color is not None:
        overrides["render.color_by"] = color
    chosen = _scene(scene, overrides)
    with _interruptible(), Progress(chosen.name) as progress:
        result = simulate(
            chosen,
            out or Path("out") / chosen.name,
            count=frames,
            render=render,
            size=_size(size),
            video_file=video,
            fields=[name.strip() for name in fields.split(",")] if fields else [],
            progress=progress.update,
        )
    _print_written(result.path, len(result.frame_indices()), render, video)


@app.command(name="render")
def render_again(
    directory: Annotated[Path, typer.Argument(metavar="DIR", help="The directory of a run.")],
    camera: Annotated[
        str | None,
        typer.Option(
            metavar="KEYS", help='Another view, for example "eye=[3, 2, 3], target=[1, 0, 0]".'
        ),
    ] = None,
    video: Video = None,
    size: Annotated[
        str | None, typer.Option(metavar="WxH", help="Size of the pictures.  [default: the run's]")
    ] = None,
    color: Color = None,
    changes: Set = None,
) -> None:
    """Render a finished run again, without simulating."""
    from pbfluids.run import draw

    overrides = _assignments(changes or [])
    if camera is not None:
        overrides["camera"] = _value(f"{{{camera}}}", f"--camera {camera}")
    if color is not None:
        overrides["render.color_by"] = color
    with _interruptible(), Progress("render") as progress:
        result = draw(
            directory,
            overrides=overrides,
            size=_size(size) if size else None,
            video_file=video,
            progress=progress.update,
        )
    _print_written(result.path, len(result.frame_indices()), True, video)


@app.command()
def scenes() -> None:
    """List the built-in scenes."""
    for name in Scene.names():
        scene = Scene.builtin(name)
        particles = len(scene.particles()[0])
        print(f"{name:18} {particles:7,} particles  {scene.duration:4g} s  {scene.description}")


@app.command()
def doctor(
    as_json: Annotated[bool, typer.Option("--json", help="For programs and bug reports.")] = False,
) -> None:
    """Say what is installed and what is missing; exit 1 if rendering cannot work."""
    from pbfluids.diagnosis import examine

    diagnosis = examine()
    print(json.dumps(diagnosis.as_dict(), indent=1) if as_json else diagnosis.text())
    if not diagnosis.can_render:
        raise typer.Exit(1)


@app.command()
def schema() -> None:
    """Print the JSON Schema of scene files."""
    print(json.dumps(Scene.json_schema(), indent=1))


@contextmanager
def _interruptible() -> Iterator[None]:
    try:
        yield
    except KeyboardInterrupt as error:
        raise Interrupted from error


def _scene(name: str, overrides: dict[str, Any]) -> Scene:
    if name.endswith(".toml") or "/" in name:
        return Scene.load(name, **overrides)
    return Scene.builtin(name, **overrides)


def _size(text: str) -> tuple[int, int]:
    match = re.fullmatch(r"(\d+)x(\d+)", text)
    if match is None:
        raise InvalidParameter(f"size = {text}: expected WIDTHxHEIGHT, for example 1280x720")
    return int(match[1]), int(match[2])


def _assignments(texts: list[str]) -> dict[str, Any]:
    """Changes for a scene from texts like ``solver.iterations=8`` or ``smoothing=gaussian``."""
    changes = {}
    for text in texts:
        key, equals, value = text.partition("=")
        if not equals:
            raise InvalidParameter(f"--set {text}: expected KEY=VALUE")
        changes[key.strip()] = _value(value.strip(), f"--set {text}")
    return changes


def _value(text: str, option: str) -> Any:
    """Read a value as TOML does; a bare word, which is no TOML, is a string."""
    try:
        read = toml.loads(f"value = {text}")
    except toml.TOMLDecodeError as error:
        if re.fullmatch(r"[A-Za-z_][\w-]*", text):
            return text
        raise InvalidParameter(f"{option}: not TOML: {error}") from error
    if len(read) > 1:
        raise InvalidParameter(f"{option}: expected one value, got lines that set others as well")
    return read["value"]


def _print_written(directory: Path, frames: int, images: bool, video: Path | None) -> None:
    print(f"{directory}/run.json")
    print(f"{directory}/particles/  {frames} frames")
    if images:
        print(f"{directory}/images/  {frames} pictures")
    if video is not None:
        print(video)
