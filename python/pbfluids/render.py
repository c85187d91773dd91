"""The renderer's Python face."""

from __future__ import annotations

import os
import warnings
from typing import TYPE_CHECKING, Literal, TypedDict, cast

from pbfluids import _core
from pbfluids._core import Camera, Mesh, RenderParams
from pbfluids.errors import SoftwareRendering

if TYPE_CHECKING:
    from collections.abc import Sequence
    from types import TracebackType

    import numpy as np
    from numpy.typing import ArrayLike, NDArray
    from typing_extensions import Self

__all__ = ["Camera", "Mesh", "RenderParams", "RenderReport", "Renderer", "colors"]


def colors(values: ArrayLike, params: RenderParams | None = None) -> NDArray[np.uint8]:
    """Give the colors that values have in a picture, for plots and legends of one's own.

    Parameters
    ----------
    values : array_like, shape (n,)
        Finite.
    params : RenderParams, optional
        ``colormap`` and ``color_range`` count.

    Returns
    -------
    ndarray, shape (n, 3), uint8
        sRGB.

    Raises
    ------
    InvalidParameter
        If the shape is another or a value not finite.
    WrongType
        If the values are no real numbers.

    """
    return _core.colors(values, params or RenderParams())


class RenderReport(TypedDict):
    """What drawing the last picture took."""

    particles: int
    #: Each pass in order and its time [ms]; empty unless the renderer was made with ``timed=True``.
    milliseconds: dict[str, float]


class Renderer:
    """Draws particles as a fluid, or as spheres, without a screen.

    The passes of screen-space fluid rendering [vdL09]_: depth of spheres, thickness, both smoothed,
    normals, and the picture. A context manager; :meth:`close` gives the graphics memory back.

    Any thread may use a renderer; calls take turns. Several renderers may live at once. After
    ``os.fork()`` the child cannot use it (nor make one, if the parent had): start workers with the
    "spawn" method.

    Parameters
    ----------
    width, height : int
        Size of the pictures [pixels], at least 1, at most what the driver draws.
    device : int or str, optional
        Whose driver to look for: the index of an EGL device as ``pbfluids doctor`` lists them,
        "hardware", "software", "cuda:N" for the GPU that CUDA calls N, or "surfaceless". If not
        given, what the environment variable ``PBF_EGL_DEVICE`` says; else the first that works
        of: GPUs in the order of CUDA, other hardware, software, Mesa's surfaceless platform.
    environment_map : array_like, shape (h, w, 3), float32, optional
        See :meth:`set_environment_map`.
    timed : bool, optional
        Measure each pass (see :attr:`report`). Waiting for each costs a little.
    backend : {"egl", "cpu"}, optional
        Who draws. Not given: OpenGL on a GPU; where there is none the same passes in C++, which
        outrun a driver that runs shaders on the processor several times over. ``"egl"``: OpenGL,
        whatever the driver. ``"cpu"``: C++, without a look at the drivers. Pictures agree within
        the rounding of their arithmetic, which is one or two of 255, but for a few pixels at edges.

    Raises
    ------
    InvalidParameter
        If the size cannot be drawn, or ``device`` means nothing.
    RendererUnavailable
        If there is no OpenGL 3.3 although it was asked for, by ``backend="egl"``, or by ``device``
        or PBF_EGL_DEVICE, which is not there; the message lists every attempt and the cure.

    Warns
    -----
    SoftwareRendering
        Once, if the processor draws and nobody asked for that: although there is a GPU, or because
        there is no OpenGL, with every attempt and the cure.

    Examples
    --------
    >>> with pbf.Renderer(1280, 720) as renderer:
    ...     image = renderer.render(positions, pbf.Camera(), pbf.RenderParams(radius=0.02))

    """

    def __init__(
        self,
        width: int,
        height: int,
        *,
        device: int | str | None = None,
        environment_map: ArrayLike | None = None,
        timed: bool = False,
        backend: Literal["egl", "cpu"] | None = None,
    ) -> None:
        wish = "" if device is None else str(device)
        self._core = _core.Renderer(width, height, wish, timed, backend)
        if environment_map is not None:
            self._core.set_environment_map(environment_map)
        self._size = (width, height)
        _say_if_software_by_accident(self._core)

    def set_environment_map(self, environment_map: ArrayLike | None) -> None:
        """Take the light that ``background`` and ``reflection`` ``"map"`` show; None takes it away.

        Parameters
        ----------
        environment_map : array_like, shape (h, w, 3), float32, or None
            Linear light from all directions: columns once around from behind over the left, ahead
            (-z, where y is up) and the right, rows from straight up to straight down. Files of
            panoramas are like this; ``pbf.read_environment_map("sky.hdr")`` reads one.

        Raises
        ------
        InvalidParameter
            If the shape is another, or light is negative or not finite.
        WrongType
            If it holds no real numbers.
        GlError
            As for :meth:`render`.

        """
        self._core.set_environment_map(environment_map)

    def render(
        self,
        positions: ArrayLike,
        camera: Camera,
        params: RenderParams | None = None,
        *,
        meshes: Sequence[Mesh] = (),
        values: ArrayLike | None = None,
    ) -> NDArray[np.uint8]:
        """Draw the particles.

        Parameters
        ----------
        positions : array_like, shape (n, 3), float32
            Positions [m]. No particles give the background.
        camera : Camera
            Where the picture is taken from.
        params : RenderParams, optional
            How the fluid is drawn.
        meshes : sequence of Mesh, optional
            Opaque things before, in and behind the fluid. They cast shadows on the floor.
            ``pbf.read_mesh("boat.obj")`` reads one.
        values : array_like, shape (n,), optional
            A number per particle that becomes its color by ``params.colormap``: spheres have it,
            fluid has the mean of the particles at its surface. Without ``params.color_range`` the
            colors span this picture's values; pictures of a video need a range to be comparable.

        Returns
        -------
        ndarray, shape (height, width, 4), uint8
            RGBA: sRGB-encoded colors, not multiplied by alpha, which is 255 everywhere unless the
            background is transparent. Row 0 is the top.

        Raises
        ------
        InvalidParameter
            If a shape is another, or a position or value is not finite.
        WrongType
            If the positions or values are no real numbers.
        GlError
            If the renderer is closed or belongs to another process, a shader does not compile or
            the driver fails.

        """
        return self._core.render(positions, camera, params or RenderParams(), list(meshes), values)

    def layers(
        self, positions: ArrayLike, camera: Camera, params: RenderParams | None = None
    ) -> dict[str, NDArray[np.float32]]:
        """Give what the picture is made from; parameters and errors as for :meth:`render`.

        Returns
        -------
        dict of ndarray, float32
            ``depth``, ``depth_smooth``: shape (height, width), front of the fluid along the viewing
            axis [m], 0 where there is none. ``thickness``, ``thickness_smooth``: shape
            (height, width), length of fluid along the pixel's ray [m]. ``normal``: shape
            (height, width, 3), unit normal in eye space (x right, y up, z towards the viewer),
            0 where there is no fluid. Of spheres, ``depth`` and ``normal`` alone.

        """
        return self._core.layers(positions, camera, params or RenderParams())

    def close(self) -> None:
        """Give back what the renderer holds. Again is harmless; drawing afterwards is a GlError."""
        self._core.close()

    @property
    def width(self) -> int:
        """Width of the pictures [pixels]."""
        return self._size[0]

    @property
    def height(self) -> int:
        """Height of the pictures [pixels]."""
        return self._size[1]

    @property
    def closed(self) -> bool:
        """Whether :meth:`close` was called."""
        return self._core.closed

    @property
    def description(self) -> str:
        """Driver, OpenGL version and device in a line."""
        return self._core.description

    @property
    def software(self) -> bool:
        """Whether the processor draws, and competes with what else runs there."""
        return self._core.software

    @property
    def missing(self) -> str | None:
        """Why there is no OpenGL, with the cure, where C++ draws for want of it; else None."""
        return self._core.missing or None

    @property
    def info(self) -> dict[str, str]:
        """Renderer, vendor and version as the driver names them, platform and why it was chosen."""
        return self._core.info

    @property
    def report(self) -> RenderReport:
        """Number of particles and times of the last picture."""
        return cast("RenderReport", self._core.report)

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self,
        exc_type: type[BaseException] | None,
        exc_value: BaseException | None,
        traceback: TracebackType | None,
    ) -> None:
        self.close()

    def __repr__(self) -> str:
        state = "closed" if self.closed else self.description
        return f"Renderer({self.width}, {self.height}: {state})"


def _say_if_software_by_accident(core: _core.Renderer) -> None:
    """Warn, once in a process, that a GPU is there and not used, or that there is no OpenGL."""
    global _said  # noqa: PLW0603
    if not _said and core.missing:
        _said = True
        lines = [
            f"C++ draws on the processor: {core.missing}",
            '  to draw on the processor and hear nothing of it: Renderer(…, backend="cpu")',
        ]
        warnings.warn("\n".join(lines), SoftwareRendering, stacklevel=3)
    asked_for = core.asked_for or "LIBGL_ALWAYS_SOFTWARE" in os.environ
    gpus = _core.visible_gpus()
    if _said or asked_for or not core.software or not gpus:
        return
    _said = True
    tried = [attempt for attempt in core.attempts if "(software)" not in attempt]
    lines = [
        f"{core.description}: this draws on the processor, although there is a GPU "
        f"({', '.join(gpus)}). Tried before:",
        *("  " + attempt for attempt in tried or ["nothing: EGL does not list the GPU"]),
        "Cure, whichever fits:",
        *("  " + cure for cure in _core.egl_cures()[1:]),
        "  to draw on the processor and hear nothing of it: PBF_EGL_DEVICE=software",
    ]
    warnings.warn("\n".join(lines), SoftwareRendering, stacklevel=3)


_said = False
