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
    "Mesh",
    "ParticleFields",
    "RenderParams",
    "Renderer",
    "Simulation",
    "SolverParams",
    "StepReport",
    "ball",
    "block",
    "build_info",
    "colors",
    "egl_cures",
    "egl_devices",
    "instruction_sets",
    "legend_ticks",
    "stages",
    "usable_threads",
    "visible_gpus",
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
        kernel: str | None = ...,
        dimensions: int = ...,
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
    def dimensions(self) -> int:
        """
        3: the fluid fills space. 2: it flows in a plane of constant z, with the kernels and the rest lattice of the plane; z of the gravity must be 0, and the domain has walls in x and y only.
        """
    @dimensions.setter
    def dimensions(self, arg1: typing.SupportsInt | typing.SupportsIndex) -> None: ...
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
    def kernel(self) -> str | None:
        """
        poly6_spiky: poly6 for densities, spiky for gradients, as in the paper; together they are no gradient of one thing, and fluid at rest simmers. cubic_spline, wendland: one kernel for both; it comes to rest. wendland if not given, poly6_spiky with the plain method.
        """
    @kernel.setter
    def kernel(self, arg1: str | None) -> None: ...
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
        method: str | None = ...,
        iterations: int | None = ...,
        min_iterations: int = ...,
        max_iterations: int = ...,
        tolerance: float = ...,
        max_tolerance: float = ...,
        compliance: float = ...,
        warm_start: float = ...,
        levels: int = ...,
        acceleration: str = ...,
        substeps: int = ...,
        time_step: str = ...,
        cfl: float = ...,
        min_time_step: float = ...,
        max_time_step: float = ...,
        relaxation: float = ...,
        constraint_floor: float | None = ...,
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
    def acceleration(self) -> str:
        """
        nesterov: iterations gather momentum, and need the root of the number that none needs. Pressure method.
        """
    @acceleration.setter
    def acceleration(self, arg1: str) -> None: ...
    @property
    def cfl(self) -> float:
        """
        Adaptive time step: how far the fastest particle may move in a step, as a share of the spacing.
        """
    @cfl.setter
    def cfl(self, arg1: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def compliance(self) -> float:
        """
        Softness of the fluid: density / rest_density - 1 = compliance * pressure / rest_density, whatever the time step. One over the speed of sound squared; 0 is incompressible. Pressure method.
        """
    @compliance.setter
    def compliance(self, arg1: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def constraint_floor(self) -> float | None:
        """
        The constraint is never taken below this; with the pressure method, the sum of a step's iterations pulls no more than this asks for. 0 pushes only, so drops come off freely; -inf pulls as well and clumps at free surfaces. If not given: -0.002 with the plain method, 0 with pressure.
        """
    @constraint_floor.setter
    def constraint_floor(
        self, arg1: typing.SupportsFloat | typing.SupportsIndex | None
    ) -> None: ...
    @property
    def iterations(self) -> int | None:
        """
        Solver iterations per time step, exactly. More make the fluid stiffer; a correction travels at most two support radii in each. If not given: 4 with the plain method, as many as the tolerances ask for with pressure.
        """
    @iterations.setter
    def iterations(self, arg1: typing.SupportsInt | typing.SupportsIndex | None) -> None: ...
    @property
    def levels(self) -> int:
        """
        2: in the first iteration of a step, a grid of cells six spacings wide solves for what is wrong over the height of the water, so that few iterations hold deep water. 1: particles only, as in space without walls. Pressure method.
        """
    @levels.setter
    def levels(self, arg1: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    @property
    def max_iterations(self) -> int:
        """
        Most iterations, tolerances met or not.
        """
    @max_iterations.setter
    def max_iterations(self, arg1: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    @property
    def max_time_step(self) -> float:
        """
        Adaptive time step: never longer than this.
        """
    @max_time_step.setter
    def max_time_step(self, arg1: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def max_tolerance(self) -> float:
        """
        Compression of the worst particle that must be reached as well. Iterations are for all particles, so a small one is dear. Near 100 the mean alone decides.
        """
    @max_tolerance.setter
    def max_tolerance(self, arg1: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def method(self) -> str | None:
        """
        plain: every iteration starts from nothing, as in the paper; cheap, and springy where water is deep. pressure: multipliers add up over a time step, a bound keeps them from pulling, and the last step's are a first guess; it holds tall columns. plain if iterations are given, else pressure.
        """
    @method.setter
    def method(self, arg1: str | None) -> None: ...
    @property
    def min_iterations(self) -> int:
        """
        Fewest iterations before tolerances are looked at.
        """
    @min_iterations.setter
    def min_iterations(self, arg1: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    @property
    def min_time_step(self) -> float:
        """
        Adaptive time step: never shorter than this, but for the last one of a frame.
        """
    @min_time_step.setter
    def min_time_step(self, arg1: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
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
        Time steps per frame where the time step is fixed. More make the fluid livelier, and with the plain method stiffer: compression falls with their square.
        """
    @substeps.setter
    def substeps(self, arg1: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    @property
    def tensile_distance(self) -> float:
        """
        Distance at which the artificial repulsion has its nominal strength, as a share of h. At the rest distance it must not exceed what fluid compressed by 100 % has; 0.1 to 0.3 are usual.
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
        Artificial repulsion between close particles, in units of 1 / D_ideal, in every iteration or, with the pressure method, once in a step. Spreads thin sheets and evens out spacing; too much inflates the fluid. The paper's k is tensile_strength / D_ideal.
        """
    @tensile_strength.setter
    def tensile_strength(self, arg1: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def time_step(self) -> str:
        """
        fixed: substeps equal parts of a frame. adaptive: as many equal parts as the fastest particle needs (cfl), found anew in each step.
        """
    @time_step.setter
    def time_step(self, arg1: str) -> None: ...
    @property
    def tolerance(self) -> float:
        """
        Mean compression, max(density / rest_density - 1, 0), at which the iterations end. Smaller is stiffer and slower. With compliance: what is left of the compression that the pressure does not account for.
        """
    @tolerance.setter
    def tolerance(self, arg1: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def vorticity(self) -> float:
        """
        Vorticity confinement: feeds eddies that the method damps. Livelier, then noisy.
        """
    @vorticity.setter
    def vorticity(self, arg1: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def warm_start(self) -> float:
        """
        Share of the last time step's pressure that the iterations start from. More needs fewer iterations in calm water; near 1 errors live on and waves build up. Less in long steps, where it would push by more than half a squared spacing. Pressure method.
        """
    @warm_start.setter
    def warm_start(self, arg1: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
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
        periodic: collections.abc.Sequence[bool] = ...,
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
    def periodic(self) -> tuple[bool, bool, bool]:
        """
        Axes along which there are no walls: what leaves the box there comes in at the opposite face, and fluid at the one face is next to fluid at the other.
        """
    @periodic.setter
    def periodic(self, arg1: tuple[bool, bool, bool]) -> None: ...
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
    def stable(self) -> bool:
        """
        False if the fluid was crushed to twice its density in the mean: the time step is too long.
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
    def pressures(self) -> numpy.typing.NDArray[numpy.float32]: ...
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
        style: str = ...,
        radius: float = ...,
        drop_radius: float | None = ...,
        particle_volume: float | None = ...,
        anisotropy: float = ...,
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
        sphere_radius: float | None = ...,
        sphere_color: collections.abc.Sequence[float] = ...,
        colormap: str = ...,
        color_range: collections.abc.Sequence[float] | None = ...,
        legend: str = ...,
        tint_depth: float | None = ...,
        background: str = ...,
        reflection: str | None = ...,
        background_color: collections.abc.Sequence[float] = ...,
        sun_direction: collections.abc.Sequence[float] = ...,
        shadow: float = ...,
        up: collections.abc.Sequence[float] = ...,
        floor: bool = ...,
        floor_height: float | None = ...,
        tank_lower: collections.abc.Sequence[float] | None = ...,
        tank_upper: collections.abc.Sequence[float] | None = ...,
        exposure: float = ...,
        tone_mapping: str = ...,
        supersampling: int = ...,
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
    def anisotropy(self) -> float:
        """
        How far sprites follow the fluid around them. 0: spheres. 1: ellipsoids, flat along the surface and long in a jet, up to four times as long as thick: edges without beads, thinner sheets, and a surface that lies half a particle distance deeper, for more time. Drops stay round.
        """
    @anisotropy.setter
    def anisotropy(self, arg1: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def background(self) -> str:
        """
        sky: a bright sky with a sun. plain: background_color everywhere. map: the renderer's environment map. transparent: nothing; the picture's alpha says how much of another background comes through floor and fluid.
        """
    @background.setter
    def background(self, arg1: str) -> None: ...
    @property
    def background_color(self) -> tuple[float, float, float]:
        """
        Color of the plain background. A transparent picture is exact over it; over others fluid that absorbs colors unequally loses a little of its tint.
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
    def color_range(self) -> tuple[float, float] | None:
        """
        Values of the first and the last color; what is beyond gets the color of that end. The least and the greatest of the picture's values if not given, so the pictures of a video need a range to be comparable. Not used by shuffled.
        """
    @color_range.setter
    def color_range(
        self,
        arg1: tuple[
            typing.SupportsFloat | typing.SupportsIndex, typing.SupportsFloat | typing.SupportsIndex
        ]
        | None,
    ) -> None: ...
    @property
    def colormap(self) -> str:
        """
        Which color a value gets. viridis, magma, cividis and gray rise in lightness, cividis looks nearly the same to color-blind eyes; coolwarm has a middle; shuffled gives whole numbers, such as ids, colors that tell neighbors apart.
        """
    @colormap.setter
    def colormap(self, arg1: str) -> None: ...
    @property
    def drop_radius(self) -> float | None:
        """
        Radius of the sprite of a particle that is alone; at most radius, which it is if not given. With 0.62 times the particle distance a drop has its particle's volume. Small groups of particles lie between, told by what is within 2.4 particle distances: cube roots of particle_volume, without it radii. The depth filter leaves drops round.
        """
    @drop_radius.setter
    def drop_radius(self, arg1: typing.SupportsFloat | typing.SupportsIndex | None) -> None: ...
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
    def legend(self) -> str:
        """
        What the values are, with unit, such as "speed [m/s]": drawn with a color bar into the picture's corner where values are given. No legend if empty.
        """
    @legend.setter
    def legend(self, arg1: str) -> None: ...
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
    def reflection(self) -> str | None:
        """
        What the surface mirrors beside the floor: sky, with studio lights, or plain, background_color everywhere, or map, the renderer's environment map. If not given, the background's own, and sky over transparency.
        """
    @reflection.setter
    def reflection(self, arg1: str | None) -> None: ...
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
    def shadow(self) -> float:
        """
        How much of the floor's light comes from the sun, and is absorbed in the fluid's shadow. 0: no shadow. 1: black where no light comes through.
        """
    @shadow.setter
    def shadow(self, arg1: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def smoothing(self) -> str:
        """
        How depth is smoothed. bilateral keeps steps of depth that are higher than smoothing_range, so that a drop stays in front of what is behind it; narrow_range also smooths across steep surfaces and rounds off the edge of what is in front; curvature_flow moves the surface by its curvature, at many times the cost; gaussian melts what is in front and behind together.
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
        Steps of depth higher than this are kept, by all but the gaussian filter; 4 * radius if not given.
        """
    @smoothing_range.setter
    def smoothing_range(self, arg1: typing.SupportsFloat | typing.SupportsIndex | None) -> None: ...
    @property
    def sphere_color(self) -> tuple[float, float, float]:
        """
        Color of spheres that are drawn without values.
        """
    @sphere_color.setter
    def sphere_color(
        self,
        arg1: tuple[
            typing.SupportsFloat | typing.SupportsIndex,
            typing.SupportsFloat | typing.SupportsIndex,
            typing.SupportsFloat | typing.SupportsIndex,
        ],
    ) -> None: ...
    @property
    def sphere_radius(self) -> float | None:
        """
        Radius of a particle drawn as a sphere, radius / 2 if not given: spheres half the particle distance large touch one another.
        """
    @sphere_radius.setter
    def sphere_radius(self, arg1: typing.SupportsFloat | typing.SupportsIndex | None) -> None: ...
    @property
    def style(self) -> str:
        """
        fluid: a liquid with a smooth surface. spheres: the particles themselves, opaque, for who wants to see what the solver does.
        """
    @style.setter
    def style(self, arg1: str) -> None: ...
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
    def supersampling(self) -> int:
        """
        The picture is drawn this many times wider and higher, and averaged in linear light: smoother edges, and as many times squared slower. Layers are not.
        """
    @supersampling.setter
    def supersampling(self, arg1: typing.SupportsInt | typing.SupportsIndex) -> None: ...
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
        How thickness is smoothed: gaussian, or bilateral, which keeps steps higher than thickness_range.
        """
    @thickness_smoothing.setter
    def thickness_smoothing(self, arg1: str) -> None: ...
    @property
    def tint_depth(self) -> float | None:
        """
        How deep fluid colored by values must be to hide 63 % of what is behind it, in place of absorption; radius if not given, which is opaque but for spray. Larger is glass.
        """
    @tint_depth.setter
    def tint_depth(self, arg1: typing.SupportsFloat | typing.SupportsIndex | None) -> None: ...
    @property
    def tone_mapping(self) -> str:
        """
        How bright light is brought into the picture. soft: values below 0.8 stay as they are. none: values above 1 are cut off. aces: the contrast of film, darker and more colorful.
        """
    @tone_mapping.setter
    def tone_mapping(self, arg1: str) -> None: ...
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

class Mesh:
    """
    An opaque thing in the scene, of one color.

    Triangles are counter-clockwise seen from outside, and not seen from inside; each is lit as the flat
    thing it is. Arrays of other libraries do, as in ``Mesh(mesh.vertices, mesh.faces)`` for one of
    trimesh.

    Parameters
    ----------
    vertices : array_like, shape (n, 3), float32
        Corners [m].
    faces : array_like, shape (m, 3), integers
        The vertices of each triangle, counted from 0.
    color : three numbers, optional
        Red, green and blue, linear, 0 to 1.

    Raises
    ------
    InvalidParameter
        If a shape is another, a vertex is not finite, a face names a vertex that is not there, or a
        color is out of range.
    WrongType
        If the arrays are no real or whole numbers.
    """
    def __init__(
        self,
        vertices: typing.Any,
        faces: typing.Any,
        color: typing.Annotated[
            collections.abc.Sequence[typing.SupportsFloat | typing.SupportsIndex], "FixedSize(3)"
        ] = [0.6, 0.6, 0.6],
    ) -> None: ...
    @property
    def color(self) -> tuple[float, float, float]: ...
    @property
    def faces(self) -> numpy.typing.NDArray[numpy.int64]: ...
    @property
    def vertices(self) -> numpy.typing.NDArray[numpy.float32]: ...

class Renderer:
    """
    Draws particles as a fluid, without a screen.
    """
    def __init__(
        self,
        width: typing.SupportsInt | typing.SupportsIndex,
        height: typing.SupportsInt | typing.SupportsIndex,
        device: str = "",
        timed: bool = False,
        backend: str | None = None,
    ) -> None: ...
    def close(self) -> None: ...
    def layers(self, positions: typing.Any, camera: Camera, params: RenderParams) -> dict: ...
    def render(
        self,
        positions: typing.Any,
        camera: Camera,
        params: RenderParams,
        meshes: list,
        values: typing.Any = None,
    ) -> numpy.typing.NDArray[numpy.uint8]: ...
    def set_environment_map(self, environment_map: typing.Any) -> None: ...
    @property
    def asked_for(self) -> bool: ...
    @property
    def attempts(self) -> list[str]: ...
    @property
    def closed(self) -> bool: ...
    @property
    def description(self) -> str: ...
    @property
    def info(self) -> dict: ...
    @property
    def missing(self) -> str: ...
    @property
    def report(self) -> dict: ...
    @property
    def software(self) -> bool: ...

def ball(
    center: typing.Annotated[
        collections.abc.Sequence[typing.SupportsFloat | typing.SupportsIndex], "FixedSize(3)"
    ],
    radius: typing.SupportsFloat | typing.SupportsIndex,
    spacing: typing.SupportsFloat | typing.SupportsIndex,
    dimensions: typing.SupportsInt | typing.SupportsIndex = 3,
) -> numpy.typing.NDArray[numpy.float32]: ...
def block(
    lower: typing.Annotated[
        collections.abc.Sequence[typing.SupportsFloat | typing.SupportsIndex], "FixedSize(3)"
    ],
    upper: typing.Annotated[
        collections.abc.Sequence[typing.SupportsFloat | typing.SupportsIndex], "FixedSize(3)"
    ],
    spacing: typing.SupportsFloat | typing.SupportsIndex,
    dimensions: typing.SupportsInt | typing.SupportsIndex = 3,
) -> numpy.typing.NDArray[numpy.float32]: ...
def build_info() -> dict[str, str]:
    """
    Compiler, instruction set and libraries of this build.
    """

def colors(values: typing.Any, params: RenderParams) -> numpy.typing.NDArray[numpy.uint8]: ...
def egl_cures() -> list[str]:
    """
    What to do where rendering, or a GPU for it, is missing.
    """

def egl_devices() -> list:
    """
    Devices that EGL lists.
    """

def instruction_sets() -> list[str]:
    """
    Instruction sets that the solver is compiled for and this processor has, plainest first.
    """

def legend_ticks(
    low: typing.SupportsFloat | typing.SupportsIndex,
    high: typing.SupportsFloat | typing.SupportsIndex,
) -> tuple[list[tuple[float, str]], int]:
    """
    Value and text of each, and the power of ten that the texts leave out.
    """

def usable_threads(requested: typing.SupportsInt | typing.SupportsIndex) -> int:
    """
    Threads used for a request, 0 being all.
    """

def visible_gpus() -> list[str]:
    """
    Device files of GPUs, usable or not.
    """
