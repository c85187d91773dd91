"""
The compiled side of pbfluids. Private: use the names of pbfluids itself.
"""

from __future__ import annotations
import collections.abc
import numpy
import numpy.typing
import typing
from . import stages

__all__: list[str] = [
    "Box",
    "Camera",
    "FluidParams",
    "ParticleFields",
    "RenderParams",
    "Renderer",
    "Simulation",
    "SolverParams",
    "StepReport",
    "ball",
    "block",
    "build_info",
    "stages",
    "usable_threads",
]

class FluidParams:
    """
    What the fluid is. SI units.
    """

    __hash__: typing.ClassVar[None] = None
    @staticmethod
    def describe() -> list:
        """
        Name, kind, unit, range, default and meaning of each field.
        """
    def __eq__(self, arg0: typing.Any) -> bool: ...
    def __init__(
        self,
        *,
        spacing: float = ...,
        support_radius: float | None = ...,
        rest_density: float = ...,
        gravity: collections.abc.Sequence[float] = ...,
        kernel: str = ...,
    ) -> None: ...
    def __repr__(self) -> str: ...
    def as_dict(self) -> dict:
        """
        The fields by name.
        """
    def replace(self, **changes: typing.Any) -> FluidParams:
        """
        A copy with some fields changed.
        """
    @property
    def gravity(self) -> tuple[float, float, float]:
        """
        Acceleration of every particle.
        """
    @gravity.setter
    def gravity(
        self,
        arg1: tuple[
            typing.SupportsFloat | typing.SupportsIndex,
            typing.SupportsFloat | typing.SupportsIndex,
            typing.SupportsFloat | typing.SupportsIndex,
        ],
    ) -> None: ...
    @property
    def h(self) -> float:
        """
        The support radius in force [m]: support_radius, or 2 * spacing.
        """
    @property
    def kernel(self) -> str:
        """
        poly6_spiky: poly6 for densities, spiky for gradients, as in the paper. cubic_spline: one kernel for both.
        """
    @kernel.setter
    def kernel(self, arg1: str) -> None: ...
    @property
    def rest_density(self) -> float:
        """
        Density at rest. Scales masses, densities and pressures; the motion does not depend on it.
        """
    @rest_density.setter
    def rest_density(self, arg1: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def spacing(self) -> float:
        """
        Particle distance at rest. Halving it makes eight times the particles and finer splashes.
        """
    @spacing.setter
    def spacing(self, arg1: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def support_radius(self) -> float | None:
        """
        Kernel support radius h, 2 * spacing if not given. Larger is smoother, slower and rounder.
        """
    @support_radius.setter
    def support_radius(self, arg1: typing.SupportsFloat | typing.SupportsIndex | None) -> None: ...

class SolverParams:
    """
    How the constraint is solved. The pure numbers mean the same at every resolution.
    """

    __hash__: typing.ClassVar[None] = None
    @staticmethod
    def describe() -> list:
        """
        Name, kind, unit, range, default and meaning of each field.
        """
    def __eq__(self, arg0: typing.Any) -> bool: ...
    def __init__(
        self,
        *,
        iterations: int = ...,
        substeps: int = ...,
        relaxation: float = ...,
        constraint_floor: float = ...,
        tensile_strength: float = ...,
        tensile_distance: float = ...,
        tensile_exponent: int = ...,
        vorticity: float = ...,
        xsph: float = ...,
        num_threads: int = ...,
    ) -> None: ...
    def __repr__(self) -> str: ...
    def as_dict(self) -> dict:
        """
        The fields by name.
        """
    def replace(self, **changes: typing.Any) -> SolverParams:
        """
        A copy with some fields changed.
        """
    @property
    def constraint_floor(self) -> float:
        """
        The constraint is never taken below this. 0 pushes only, so drops come off freely; -inf pulls as well and clumps at free surfaces.
        """
    @constraint_floor.setter
    def constraint_floor(self, arg1: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def iterations(self) -> int:
        """
        Solver iterations per time step. More make the fluid stiffer; a correction travels at most two support radii in each.
        """
    @iterations.setter
    def iterations(self, arg1: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    @property
    def num_threads(self) -> int:
        """
        Threads, 0 for all. The result has the same bits for any number.
        """
    @num_threads.setter
    def num_threads(self, arg1: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    @property
    def relaxation(self) -> float:
        """
        Added to the multiplier's denominator, as a share of its value on the rest lattice. Larger is softer and calmer. The paper's epsilon is relaxation * D_ideal.
        """
    @relaxation.setter
    def relaxation(self, arg1: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def substeps(self) -> int:
        """
        Time steps per frame. More make the fluid stiffer and livelier: compression falls with their square.
        """
    @substeps.setter
    def substeps(self, arg1: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    @property
    def tensile_distance(self) -> float:
        """
        Distance at which the artificial repulsion has its nominal strength, as a share of h.
        """
    @tensile_distance.setter
    def tensile_distance(self, arg1: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def tensile_exponent(self) -> int:
        """
        How steeply the artificial repulsion grows as particles close up.
        """
    @tensile_exponent.setter
    def tensile_exponent(self, arg1: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    @property
    def tensile_strength(self) -> float:
        """
        Artificial repulsion between close particles, in units of 1 / D_ideal. Spreads thin sheets and evens out spacing; too much inflates the fluid. The paper's k is tensile_strength / D_ideal.
        """
    @tensile_strength.setter
    def tensile_strength(self, arg1: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def vorticity(self) -> float:
        """
        Vorticity confinement: feeds eddies that the method damps. Livelier, then noisy.
        """
    @vorticity.setter
    def vorticity(self, arg1: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def xsph(self) -> float:
        """
        Share of the mean neighboring velocity taken over in each step. More is syrupy and coherent.
        """
    @xsph.setter
    def xsph(self, arg1: typing.SupportsFloat | typing.SupportsIndex) -> None: ...

class Box:
    """
    An axis-aligned tank: particles stay in the closed box.
    """

    __hash__: typing.ClassVar[None] = None
    @staticmethod
    def describe() -> list:
        """
        Name, kind, unit, range, default and meaning of each field.
        """
    def __eq__(self, arg0: typing.Any) -> bool: ...
    def __init__(
        self,
        lower: collections.abc.Sequence[float] = ...,
        upper: collections.abc.Sequence[float] = ...,
    ) -> None: ...
    def __repr__(self) -> str: ...
    def as_dict(self) -> dict:
        """
        The fields by name.
        """
    def replace(self, **changes: typing.Any) -> Box:
        """
        A copy with some fields changed.
        """
    @property
    def lower(self) -> tuple[float, float, float]:
        """
        Corner with the smallest coordinates.
        """
    @lower.setter
    def lower(
        self,
        arg1: tuple[
            typing.SupportsFloat | typing.SupportsIndex,
            typing.SupportsFloat | typing.SupportsIndex,
            typing.SupportsFloat | typing.SupportsIndex,
        ],
    ) -> None: ...
    @property
    def upper(self) -> tuple[float, float, float]:
        """
        Corner with the largest coordinates.
        """
    @upper.setter
    def upper(
        self,
        arg1: tuple[
            typing.SupportsFloat | typing.SupportsIndex,
            typing.SupportsFloat | typing.SupportsIndex,
            typing.SupportsFloat | typing.SupportsIndex,
        ],
    ) -> None: ...

class StepReport:
    """
    What a time step, or several, did.
    """
    def __repr__(self) -> str: ...
    def add(self, next: StepReport) -> None:
        """
        Take in the report of the step that followed.
        """
    @property
    def iterations(self) -> int:
        """
        Solver iterations, all steps together.
        """
    @property
    def max_density_error(self) -> float:
        """
        The largest compression.
        """
    @property
    def mean_density_error(self) -> float:
        """
        Mean over particles of max(density / rest_density - 1, 0): compression only.
        """
    @property
    def milliseconds(self) -> dict[str, float]:
        """
        Milliseconds by stage.
        """
    @property
    def steps(self) -> int:
        """
        Time steps reported on.
        """
    @property
    def total_milliseconds(self) -> float:
        """
        All stages together.
        """

class Simulation:
    """
    Position Based Fluids. Use pbfluids.Simulation.
    """
    def __init__(self, fluid: FluidParams, solver: SolverParams, domain: Box | None) -> None: ...
    def add_particles(
        self, positions: typing.Any, velocities: typing.Any = None
    ) -> numpy.typing.NDArray[numpy.int64]: ...
    def advance(self, seconds: typing.SupportsFloat | typing.SupportsIndex) -> StepReport: ...
    def densities(self) -> numpy.typing.NDArray[numpy.float32]: ...
    def domain(self) -> Box | None: ...
    def fluid(self) -> FluidParams: ...
    def ids(self) -> numpy.typing.NDArray[numpy.int64]: ...
    def multipliers(self) -> numpy.typing.NDArray[numpy.float32]: ...
    def positions(self) -> numpy.typing.NDArray[numpy.float32]: ...
    def set_solver(self, solver: SolverParams) -> None: ...
    def size(self) -> int: ...
    def solver(self) -> SolverParams: ...
    def state_hash(self) -> int: ...
    def step(self, dt: typing.SupportsFloat | typing.SupportsIndex) -> StepReport: ...
    def step_count(self) -> int: ...
    def time(self) -> float: ...
    def velocities(self) -> numpy.typing.NDArray[numpy.float32]: ...

class ParticleFields:
    """
    A cloud of particles on which fields are differentiated.
    """
    def __init__(
        self,
        positions: typing.Any,
        support_radius: typing.SupportsFloat | typing.SupportsIndex,
        volume: typing.SupportsFloat | typing.SupportsIndex,
        kernel: str,
        corrected: bool,
        num_threads: typing.SupportsInt | typing.SupportsIndex,
    ) -> None: ...
    def curl(self, arg0: typing.Any) -> numpy.typing.NDArray[numpy.float32]: ...
    def divergence(self, arg0: typing.Any) -> numpy.typing.NDArray[numpy.float32]: ...
    def gradient(self, arg0: typing.Any) -> numpy.typing.NDArray[numpy.float32]: ...
    def jacobian(self, arg0: typing.Any) -> numpy.typing.NDArray[numpy.float32]: ...
    def laplacian(self, arg0: typing.Any) -> numpy.typing.NDArray[numpy.float32]: ...
    def relative_density(self) -> numpy.typing.NDArray[numpy.float32]: ...

class Camera:
    """
    Where the picture is taken from.
    """

    __hash__: typing.ClassVar[None] = None
    @staticmethod
    def describe() -> list:
        """
        Name, kind, unit, range, default and meaning of each field.
        """
    def __eq__(self, arg0: typing.Any) -> bool: ...
    def __init__(
        self,
        *,
        eye: collections.abc.Sequence[float] = ...,
        target: collections.abc.Sequence[float] = ...,
        up: collections.abc.Sequence[float] = ...,
        fov_y: float = ...,
        orthographic: bool = ...,
        height: float = ...,
        near: float = ...,
        far: float = ...,
    ) -> None: ...
    def __repr__(self) -> str: ...
    def as_dict(self) -> dict:
        """
        The fields by name.
        """
    def replace(self, **changes: typing.Any) -> Camera:
        """
        A copy with some fields changed.
        """
    @property
    def eye(self) -> tuple[float, float, float]:
        """
        Where the camera stands.
        """
    @eye.setter
    def eye(
        self,
        arg1: tuple[
            typing.SupportsFloat | typing.SupportsIndex,
            typing.SupportsFloat | typing.SupportsIndex,
            typing.SupportsFloat | typing.SupportsIndex,
        ],
    ) -> None: ...
    @property
    def far(self) -> float:
        """
        Fluid beyond this is cut off.
        """
    @far.setter
    def far(self, arg1: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def fov_y(self) -> float:
        """
        Vertical field of view. Not used if orthographic.
        """
    @fov_y.setter
    def fov_y(self, arg1: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def height(self) -> float:
        """
        Height of the picture in the scene, if orthographic.
        """
    @height.setter
    def height(self, arg1: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def near(self) -> float:
        """
        Fluid nearer than this is cut off. Along the viewing direction, as far is.
        """
    @near.setter
    def near(self, arg1: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def orthographic(self) -> bool:
        """
        Parallel projection: no vanishing points, and every pixel the same area.
        """
    @orthographic.setter
    def orthographic(self, arg1: bool) -> None: ...
    @property
    def target(self) -> tuple[float, float, float]:
        """
        The point in mid-picture.
        """
    @target.setter
    def target(
        self,
        arg1: tuple[
            typing.SupportsFloat | typing.SupportsIndex,
            typing.SupportsFloat | typing.SupportsIndex,
            typing.SupportsFloat | typing.SupportsIndex,
        ],
    ) -> None: ...
    @property
    def up(self) -> tuple[float, float, float]:
        """
        The direction that points up in the picture. Any length but zero.
        """
    @up.setter
    def up(
        self,
        arg1: tuple[
            typing.SupportsFloat | typing.SupportsIndex,
            typing.SupportsFloat | typing.SupportsIndex,
            typing.SupportsFloat | typing.SupportsIndex,
        ],
    ) -> None: ...

class RenderParams:
    """
    How the fluid is drawn. SI units; colors are linear, 0 to 1.
    """

    __hash__: typing.ClassVar[None] = None
    @staticmethod
    def describe() -> list:
        """
        Name, kind, unit, range, default and meaning of each field.
        """
    def __eq__(self, arg0: typing.Any) -> bool: ...
    def __init__(
        self,
        *,
        radius: float = ...,
        particle_volume: float | None = ...,
        smoothing: str = ...,
        smoothing_radius: float | None = ...,
        smoothing_range: float | None = ...,
        smoothing_iterations: int = ...,
        thickness_smoothing: str = ...,
        thickness_radius: float | None = ...,
        thickness_range: float | None = ...,
        thickness_iterations: int = ...,
        absorption: collections.abc.Sequence[float] = ...,
        scatter: collections.abc.Sequence[float] = ...,
        refractive_index: float = ...,
        background: str = ...,
        background_color: collections.abc.Sequence[float] = ...,
        sun_direction: collections.abc.Sequence[float] = ...,
        up: collections.abc.Sequence[float] = ...,
        floor: bool = ...,
        floor_height: float | None = ...,
        tank_lower: collections.abc.Sequence[float] | None = ...,
        tank_upper: collections.abc.Sequence[float] | None = ...,
        exposure: float = ...,
    ) -> None: ...
    def __repr__(self) -> str: ...
    def as_dict(self) -> dict:
        """
        The fields by name.
        """
    def replace(self, **changes: typing.Any) -> RenderParams:
        """
        A copy with some fields changed.
        """
    @property
    def absorption(self) -> tuple[float, float, float]:
        """
        Share of red, green and blue light lost per meter (Beer-Lambert). Larger is darker and more colorful.
        """
    @absorption.setter
    def absorption(
        self,
        arg1: tuple[
            typing.SupportsFloat | typing.SupportsIndex,
            typing.SupportsFloat | typing.SupportsIndex,
            typing.SupportsFloat | typing.SupportsIndex,
        ],
    ) -> None: ...
    @property
    def background(self) -> str:
        """
        sky: a bright sky with a sun. plain: background_color everywhere.
        """
    @background.setter
    def background(self, arg1: str) -> None: ...
    @property
    def background_color(self) -> tuple[float, float, float]:
        """
        Color of the plain background.
        """
    @background_color.setter
    def background_color(
        self,
        arg1: tuple[
            typing.SupportsFloat | typing.SupportsIndex,
            typing.SupportsFloat | typing.SupportsIndex,
            typing.SupportsFloat | typing.SupportsIndex,
        ],
    ) -> None: ...
    @property
    def exposure(self) -> float:
        """
        Brightness of the picture.
        """
    @exposure.setter
    def exposure(self, arg1: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def floor(self) -> bool:
        """
        Whether a floor is drawn.
        """
    @floor.setter
    def floor(self, arg1: bool) -> None: ...
    @property
    def floor_height(self) -> float | None:
        """
        Where the floor lies along up; the bottom of the tank if not given, without a tank 0.
        """
    @floor_height.setter
    def floor_height(self, arg1: typing.SupportsFloat | typing.SupportsIndex | None) -> None: ...
    @property
    def particle_volume(self) -> float | None:
        """
        Volume that a particle adds to the thickness, the sprite's own if not given. With the cube of the particle distance, thickness is the length of the path through the fluid.
        """
    @particle_volume.setter
    def particle_volume(self, arg1: typing.SupportsFloat | typing.SupportsIndex | None) -> None: ...
    @property
    def radius(self) -> float:
        """
        Radius of a particle's sprite. Sprites must overlap: the particle distance is a good value.
        """
    @radius.setter
    def radius(self, arg1: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def refractive_index(self) -> float:
        """
        1.333 for water. Bends what is seen through the fluid and makes its surface a mirror.
        """
    @refractive_index.setter
    def refractive_index(self, arg1: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def scatter(self) -> tuple[float, float, float]:
        """
        Color that deep fluid glows with instead of turning black.
        """
    @scatter.setter
    def scatter(
        self,
        arg1: tuple[
            typing.SupportsFloat | typing.SupportsIndex,
            typing.SupportsFloat | typing.SupportsIndex,
            typing.SupportsFloat | typing.SupportsIndex,
        ],
    ) -> None: ...
    @property
    def smoothing(self) -> str:
        """
        bilateral keeps steps of depth that are higher than smoothing_range, so that a drop stays in front of what is behind it; gaussian melts them together.
        """
    @smoothing.setter
    def smoothing(self, arg1: str) -> None: ...
    @property
    def smoothing_iterations(self) -> int:
        """
        How often the depth filter runs. More is smoother and slower.
        """
    @smoothing_iterations.setter
    def smoothing_iterations(self, arg1: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    @property
    def smoothing_radius(self) -> float | None:
        """
        Where the depth filter's kernel ends, 2 * radius if not given; its standard deviation is half of that. Larger is smoother and rounder.
        """
    @smoothing_radius.setter
    def smoothing_radius(
        self, arg1: typing.SupportsFloat | typing.SupportsIndex | None
    ) -> None: ...
    @property
    def smoothing_range(self) -> float | None:
        """
        Steps of depth higher than this are kept by the bilateral filter, 4 * radius if not given.
        """
    @smoothing_range.setter
    def smoothing_range(self, arg1: typing.SupportsFloat | typing.SupportsIndex | None) -> None: ...
    @property
    def sun_direction(self) -> tuple[float, float, float]:
        """
        Towards the sun. Any length but zero.
        """
    @sun_direction.setter
    def sun_direction(
        self,
        arg1: tuple[
            typing.SupportsFloat | typing.SupportsIndex,
            typing.SupportsFloat | typing.SupportsIndex,
            typing.SupportsFloat | typing.SupportsIndex,
        ],
    ) -> None: ...
    @property
    def tank_lower(self) -> tuple[float, float, float] | None:
        """
        A corner of the tank whose edges are drawn; none if not given.
        """
    @tank_lower.setter
    def tank_lower(
        self,
        arg1: tuple[
            typing.SupportsFloat | typing.SupportsIndex,
            typing.SupportsFloat | typing.SupportsIndex,
            typing.SupportsFloat | typing.SupportsIndex,
        ]
        | None,
    ) -> None: ...
    @property
    def tank_upper(self) -> tuple[float, float, float] | None:
        """
        The opposite corner.
        """
    @tank_upper.setter
    def tank_upper(
        self,
        arg1: tuple[
            typing.SupportsFloat | typing.SupportsIndex,
            typing.SupportsFloat | typing.SupportsIndex,
            typing.SupportsFloat | typing.SupportsIndex,
        ]
        | None,
    ) -> None: ...
    @property
    def thickness_iterations(self) -> int:
        """
        How often the thickness filter runs.
        """
    @thickness_iterations.setter
    def thickness_iterations(self, arg1: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    @property
    def thickness_radius(self) -> float | None:
        """
        As smoothing_radius, for the thickness; 2 * radius if not given.
        """
    @thickness_radius.setter
    def thickness_radius(
        self, arg1: typing.SupportsFloat | typing.SupportsIndex | None
    ) -> None: ...
    @property
    def thickness_range(self) -> float | None:
        """
        As smoothing_range, for the thickness.
        """
    @thickness_range.setter
    def thickness_range(self, arg1: typing.SupportsFloat | typing.SupportsIndex | None) -> None: ...
    @property
    def thickness_smoothing(self) -> str:
        """
        As smoothing, for the thickness.
        """
    @thickness_smoothing.setter
    def thickness_smoothing(self, arg1: str) -> None: ...
    @property
    def up(self) -> tuple[float, float, float]:
        """
        Up in the scene: the floor lies across it, the zenith is there. Any length but zero.
        """
    @up.setter
    def up(
        self,
        arg1: tuple[
            typing.SupportsFloat | typing.SupportsIndex,
            typing.SupportsFloat | typing.SupportsIndex,
            typing.SupportsFloat | typing.SupportsIndex,
        ],
    ) -> None: ...

class Renderer:
    """
    Draws particles as a fluid, without a screen.
    """
    def __init__(
        self,
        width: typing.SupportsInt | typing.SupportsIndex,
        height: typing.SupportsInt | typing.SupportsIndex,
        timed: bool = False,
    ) -> None: ...
    def close(self) -> None: ...
    def layers(self, positions: typing.Any, camera: Camera, params: RenderParams) -> dict: ...
    def render(
        self, positions: typing.Any, camera: Camera, params: RenderParams
    ) -> numpy.typing.NDArray[numpy.uint8]: ...
    @property
    def closed(self) -> bool: ...
    @property
    def description(self) -> str: ...
    @property
    def info(self) -> dict: ...
    @property
    def report(self) -> dict: ...

def ball(
    center: typing.Annotated[
        collections.abc.Sequence[typing.SupportsFloat | typing.SupportsIndex], "FixedSize(3)"
    ],
    radius: typing.SupportsFloat | typing.SupportsIndex,
    spacing: typing.SupportsFloat | typing.SupportsIndex,
) -> numpy.typing.NDArray[numpy.float32]: ...
def block(
    lower: typing.Annotated[
        collections.abc.Sequence[typing.SupportsFloat | typing.SupportsIndex], "FixedSize(3)"
    ],
    upper: typing.Annotated[
        collections.abc.Sequence[typing.SupportsFloat | typing.SupportsIndex], "FixedSize(3)"
    ],
    spacing: typing.SupportsFloat | typing.SupportsIndex,
) -> numpy.typing.NDArray[numpy.float32]: ...
def build_info() -> dict[str, str]:
    """
    Compiler, instruction set and libraries of this build.
    """

def usable_threads(requested: typing.SupportsInt | typing.SupportsIndex) -> int:
    """
    Threads used for a request, 0 being all.
    """
