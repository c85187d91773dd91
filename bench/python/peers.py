"""The solvers that vs_peers.py compares, all behind the same few calls.

A further solver is a class with the members of `Solver` and an entry in SYSTEMS. Solvers are
imported where they are used: each lives in a process of its own, with its own threads.
"""

from __future__ import annotations

import itertools
import json
import tempfile
from collections.abc import Callable
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

GRAVITY = (0.0, -9.81, 0.0)


@dataclass(frozen=True)
class DamBreak:
    """A cube of fluid about to fall over in a tank three times as long: bench/cpp/stages.cpp."""

    side: int = 39  # particles along an edge of the cube
    spacing: float = 0.02
    time_step: float = 1 / 240
    iterations: int = 4
    threads: int = 2
    xsph: float = 0.0
    vorticity: float = 0.0

    @property
    def edge(self) -> float:
        return self.side * self.spacing

    @property
    def tank(self) -> tuple[float, float, float]:
        return 3 * self.edge, 2 * self.edge, self.edge


class Solver(Protocol):
    """The dam break at its start."""

    support_radius: float  # [m]
    kernel: str  # that densities are found with, as pbfluids.operators calls it
    search_ms: float | None  # spent in the neighbor search until now; None if it does not say

    def step(self) -> None:
        """Advance by one time step."""

    def advance(self, seconds: float) -> int:
        """Advance by that time, in steps as long as the solver finds right; return how many."""

    def positions(self) -> NDArray[np.float32]:
        """Return the particles' centers, shape (n, 3)."""


class PBFluids:
    """Ours: the plain method with so many iterations, or as it comes, which is by tolerance."""

    def __init__(self, case: DamBreak, *, as_it_comes: bool = False) -> None:
        import pbfluids as pbf

        self.time_step = case.time_step
        self.support_radius = 2 * case.spacing
        self.search_ms = 0.0
        solver = pbf.SolverParams(num_threads=case.threads)
        if not as_it_comes:
            solver = solver.replace(
                iterations=case.iterations, xsph=case.xsph, vorticity=case.vorticity
            )
        fluid = pbf.FluidParams(spacing=case.spacing, gravity=GRAVITY)
        self.kernel = "wendland" if as_it_comes else "poly6_spiky"
        self.simulation = pbf.Simulation(fluid, solver, domain=pbf.Box((0, 0, 0), case.tank))
        self.simulation.add_particles(pbf.block((0, 0, 0), (case.edge,) * 3, case.spacing))

    def step(self) -> None:
        self.search_ms += self.simulation.step(self.time_step).milliseconds["neighbors"]

    def advance(self, seconds: float) -> int:
        return self.simulation.advance(seconds / 3, frames=3).steps

    def positions(self) -> NDArray[np.float32]:
        return self.simulation.positions


class SPlisHSPlasH:
    """pySPlisHSPlasH with one of its pressure solvers, everything else as it comes."""

    CUBE_FACES = "124 143 578 586 156 162 348 387 137 175 268 284"  # outward, as lines of an .obj

    def __init__(
        self, case: DamBreak, method: str, iterations: int | None = None, *, cfl: bool = False
    ) -> None:
        import pysplishsplash as sph

        self.sph = sph
        self.count = case.side**3
        self.method = method
        self.kernel = "poly6_spiky" if method == "PBF" else "cubic_spline"  # as it chooses itself
        self.iterations = iterations  # exactly so many; None for its own stopping rule
        self.cfl = cfl  # time steps by its own rule instead of the case's
        self.folder = tempfile.TemporaryDirectory()
        self.base = sph.Exec.SimulatorBase()
        self.base.init(
            sceneFile=str(self._write_scene(Path(self.folder.name), case, method)),
            outputDir=self.folder.name,
            useCache=False,
            useGui=False,
            stopAt=case.time_step / 2,
        )
        self.base.initSimulation()
        self.simulation = sph.Simulation.getCurrent()
        self.fluid = self.simulation.getFluidModel(0)
        self._set_parameters(case)
        # Walls are built by runSimulation alone. It stops after the first step, the rest is ours.
        self.base.runSimulation()
        self.base.setValueFloat(self.base.STOP_AT, -1.0)
        self.support_radius = self.simulation.getSupportRadius()

    @classmethod
    def _write_scene(cls, folder: Path, case: DamBreak, method: str) -> Path:
        import pysplishsplash as sph

        corners = itertools.product((-0.5, 0.5), repeat=3)
        lines = [f"v {x} {y} {z}" for x, y, z in corners]
        lines += ["f " + " ".join(face) for face in cls.CUBE_FACES.split()]
        (folder / "cube.obj").write_text("\n".join(lines), encoding="ascii")

        # A spacing farther out than ours: its walls push from afar and throw off a block that is
        # nearer. It leaves as much in its own DoubleDamBreak. The fluid then fills the same space.
        size = [length + 2 * case.spacing for length in case.tank]
        walls = {
            "geometryFile": "cube.obj",
            "translation": [length / 2 for length in case.tank],
            "scale": size,
            "isWall": True,
            "mapInvert": True,
            # Cells of 2.5 spacings, as in its DoubleDamBreak.
            "mapResolution": [round(length / (2.5 * case.spacing)) for length in size],
        }
        # It leaves a whole spacing between the faces of a block and the first particles.
        half = case.spacing / 2
        block = {"start": [-half] * 3, "end": [case.edge + half] * 3}
        scene = {
            "Configuration": {
                "particleRadius": case.spacing / 2,
                "simulationMethod": getattr(sph.SimulationMethods, method).value,
                "timeStepSize": case.time_step,
                "cflMethod": 0,  # the time step stays as it is
                "gravitation": GRAVITY,
            },
            "Materials": [{"id": "Fluid", "maxEmitterParticles": 0}],
            "RigidBodies": [walls],
            "FluidBlocks": [{"id": "Fluid", "denseMode": 0, **block}],
        }
        path = folder / "scene.json"
        path.write_text(json.dumps(scene), encoding="ascii")
        return path

    def _set_parameters(self, case: DamBreak) -> None:
        """Set what version 2.19 does not take from the scene without its window."""
        if self.iterations:
            pressure = self.simulation.getTimeStep()
            pressure.setValueUInt(pressure.MIN_ITERATIONS, self.iterations)
            pressure.setValueUInt(pressure.MAX_ITERATIONS, self.iterations)
        if self.cfl:
            method = self.simulation.ENUM_CFL_STANDARD
            self.simulation.setValueInt(self.simulation.CFL_METHOD, method)
        xsph = self.fluid.getXSPH()
        xsph.setValueFloat(xsph.FLUID_COEFFICIENT, case.xsph)
        if case.vorticity:
            self.fluid.setVorticityMethod("Vorticity confinement")
            confinement = self.fluid.getVorticityBase()
            confinement.setValueFloat(confinement.VORTICITY_COEFFICIENT, case.vorticity)

    @property
    def search_ms(self) -> float:
        timers = self.sph.Utilities.Timing.m_averageTimes.values()
        return sum(t.totalTime for t in timers if t.name == "neighborhood_search")

    def step(self) -> None:
        self.base.timeStepNoGUI()

    def advance(self, seconds: float) -> int:
        clock = self.sph.TimeManager.getCurrent()
        end, steps = clock.getTime() + seconds, 0
        while clock.getTime() < end:
            self.step()
            steps += 1
        return steps

    def positions(self) -> NDArray[np.float32]:
        solver = self.simulation.getTimeStep()
        method, iterations = solver.getMethodName(), solver.getNumIterations()
        if method != self.method or self.iterations not in {None, iterations}:
            raise RuntimeError(f"ran {iterations} iterations of {method}, not what was asked for")
        return np.array(self.fluid.getFieldBuffer("position"))[: self.count]


class Genesis:
    """Genesis' PBD.Liquid on the CPU. XSPH is always on in it, vorticity confinement never."""

    search_ms = None
    kernel = "poly6_spiky"

    def __init__(self, case: DamBreak) -> None:
        import genesis as gs

        gs.init(backend=gs.cpu, precision="32", logging_level="error")
        self.support_radius = 1.25 * case.spacing  # fixed in its solver
        # Its walls stop centers, so they are where ours would; particles on them it refuses.
        gap = 0.499 * case.spacing
        self.scene = gs.Scene(
            show_viewer=False,
            sim_options=gs.options.SimOptions(dt=case.time_step, substeps=1, gravity=GRAVITY),
            pbd_options=gs.options.PBDOptions(
                particle_size=case.spacing,
                max_density_solver_iterations=case.iterations,
                lower_bound=(gap,) * 3,
                upper_bound=tuple(length - gap for length in case.tank),
            ),
        )
        # Density 1 and full relaxation as in its own example of a liquid: at the default of 1000
        # the constraint's gradients drown in its regularization and the fluid falls flat.
        self.fluid = self.scene.add_entity(
            material=gs.materials.PBD.Liquid(
                rho=1.0, density_relaxation=1.0, viscosity_relaxation=case.xsph, sampler="regular"
            ),
            morph=gs.morphs.Box(lower=(0, 0, 0), upper=(case.edge,) * 3),
        )
        self.scene.build()

    def step(self) -> None:
        self.scene.step(update_visualizer=False)

    def advance(self, seconds: float) -> int:
        steps = round(seconds / self.scene.sim_options.dt)
        for _ in range(steps):
            self.step()
        return steps

    def positions(self) -> NDArray[np.float32]:
        return self.fluid.get_particles_pos().numpy()


# What a step does → the changes to DamBreak. The amounts mean something else in each solver; the
# work does not depend on them.
WORK: dict[str, dict[str, float]] = {
    "density constraint": {},
    "with XSPH": {"xsph": 0.01},
    "with XSPH and vorticity": {"xsph": 0.01, "vorticity": 0.01},
}
# Not a step but a simulated second, every solver with the time step and the tolerance it comes
# with.
SECOND = "a second"


@dataclass(frozen=True)
class System:
    """How to get a solver, and what it can do."""

    make: Callable[[DamBreak], Solver]
    package: str  # on PyPI
    needs: str  # said if it does not start
    work: tuple[str, ...] = tuple(WORK)
    environment: dict[str, str] = field(default_factory=dict)


def six_iterations(case: DamBreak) -> PBFluids:
    return PBFluids(replace(case, iterations=6))


def as_it_comes(case: DamBreak) -> PBFluids:
    return PBFluids(case, as_it_comes=True)


def divergence_free(case: DamBreak) -> SPlisHSPlasH:
    return SPlisHSPlasH(case, "DFSPH", cfl=True)


def position_based(case: DamBreak) -> SPlisHSPlasH:
    return SPlisHSPlasH(case, "PBF", iterations=case.iterations)


# pySPlisHSPlasH's wheel comes with parts of OpenGL that crash unless the system's are loaded first.
LIBGL = "the system's libGL.so.1 (Debian: libgl1)"
PRELOAD = {"LD_PRELOAD": "libGL.so.1"}

OURS = "pbfluids"
SYSTEMS: dict[str, System] = {
    OURS: System(PBFluids, "pbfluids", needs="an installed pbfluids"),
    # About the density error that pySPlisHSPlasH has after four.
    "pbfluids, 6 iterations": System(
        six_iterations, "pbfluids", needs="an installed pbfluids", work=("density constraint",)
    ),
    "pbfluids, as it comes": System(
        as_it_comes, "pbfluids", needs="an installed pbfluids", work=(SECOND,)
    ),
    "pySPlisHSPlasH DFSPH": System(
        divergence_free, "pySPlisHSPlasH", LIBGL, work=(SECOND,), environment=PRELOAD
    ),
    "pySPlisHSPlasH PBF": System(
        position_based,
        "pySPlisHSPlasH",
        LIBGL,
        environment=PRELOAD,
    ),
    "Genesis PBD.Liquid": System(
        Genesis, "genesis-world", needs="torch, for CPUs will do", work=("with XSPH",)
    ),
}
