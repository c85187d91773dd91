"""Every compiled stage of the solver against the float64 reference.

Both sides see the same float32 numbers, so a difference is rounding inside the stage. With EPS the
distance from 1 to the next float32, a term of a sum carries a handful of roundings, and a sum of up
to 80 terms (h = 2.5 d) some ten more in the mean; boundary particles are placed to EPS |q|, or
12 EPS h here. Tolerances are `ROUNDINGS` times EPS times the natural size of the result, which
each test states.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
import pytest
import reference as ref
from numpy.typing import NDArray
from reference.samples import jittered_block, lattice_block

import pbfluids as pbf
from pbfluids._core import stages

Array = NDArray[np.float64]

EPS = float(np.finfo(np.float32).eps)
ROUNDINGS = 16  # twice the largest seen
D = 0.02  # spacing [m]
CORNER = np.array([-0.1, 0.05, 0.3])  # lower corner of the boxes: no coordinate starts at 0
LOOSE = math.inf

FLUIDS = {
    f"{kernel} h={h_over_d}d": pbf.FluidParams(
        spacing=D, support_radius=None if h_over_d == 2.0 else h_over_d * D, kernel=kernel
    )
    for kernel in ("poly6_spiky", "cubic_spline", "wendland")
    for h_over_d in (1.5, 2.0, 2.5)
}
SOLVERS = {
    "two-sided": pbf.SolverParams(constraint_floor=-LOOSE, tensile_strength=0.0),
    "pushing, tensile": pbf.SolverParams(
        constraint_floor=0.0, tensile_strength=0.1, tensile_distance=0.2, relaxation=0.05
    ),
    "between, odd exponent": pbf.SolverParams(
        constraint_floor=-0.01, tensile_strength=0.02, tensile_distance=0.3, tensile_exponent=3
    ),
}


@dataclass(frozen=True)
class Sample:
    """Particles as the solver sees them, and the box that holds them."""

    x: NDArray[np.float32]
    box: pbf.Box | None


def in_box(cells: tuple[float, float, float], x: Array) -> Sample:
    """x in units of the box's own cells; a box of `cells` spacings per axis."""
    upper = CORNER + D * np.array(cells)
    box = pbf.Box(tuple(CORNER), tuple(upper))
    bounds = ref.Box.of(box)
    return Sample(np.clip(CORNER + x, bounds.lower, bounds.upper).astype(np.float32), box)


def open_space(x: Array) -> Sample:
    return Sample((CORNER + x).astype(np.float32), None)


def on_walls(cells: tuple[int, int, int]) -> Array:
    """Faces, edges and corners of the box, and points just off them."""
    size = D * np.array(cells)
    grid = np.stack(np.meshgrid(*[[0.0, 0.5, 1.0]] * 3, indexing="ij"), axis=-1).reshape(-1, 3)
    return np.vstack([grid * size, 0.02 * size + 0.96 * grid * size])


SAMPLES = {
    "no particle": open_space(np.empty((0, 3))),
    "one particle": open_space(np.zeros((1, 3))),
    "one particle in a corner": in_box((4, 4, 4), np.zeros((1, 3))),
    "lattice with a free surface": open_space(lattice_block(5, D)),
    "jittered, free surface": open_space(jittered_block(6, D, seed=20, share=0.3)),
    "compressed": open_space(0.85 * jittered_block(6, D, seed=21, share=0.1)),
    "isolated and barely touching": open_space(
        D * np.array([[0, 0, 0], [1.49, 0, 0], [0, 1.99, 0], [0, 0, 2.49], [50, 0, 0], [50, 9, 0]])
    ),
    "coincident": open_space(
        np.vstack([jittered_block(3, D, seed=22), jittered_block(3, D, seed=22)[:9]])
    ),
    "full tank": in_box((5, 5, 5), jittered_block(5, D, seed=23, share=0.4)),
    "walls, edges and corners": in_box(
        (5, 4, 6), np.vstack([on_walls((5, 4, 6)), jittered_block((5, 4, 6), D, seed=24)])
    ),
    "box sizes that d does not divide": in_box(
        (5.3, 3.6, 4.45), jittered_block((5, 3, 4), D, seed=25, share=0.4)
    ),
    "slab thinner than h": in_box((1.1, 6.0, 6.0), jittered_block((1, 6, 6), D, seed=26)),
}

each_fluid = pytest.mark.parametrize("fluid", FLUIDS.values(), ids=FLUIDS.keys())
each_solver = pytest.mark.parametrize("solver", SOLVERS.values(), ids=SOLVERS.keys())
each_sample = pytest.mark.parametrize("sample", SAMPLES.values(), ids=SAMPLES.keys())


def exact(sample: Sample) -> Array:
    return sample.x.astype(np.float64)


def near_of(sample: Sample, fluid: pbf.FluidParams) -> ref.Neighbors:
    return ref.find_neighbors(exact(sample), ref.Fluid.of(fluid), ref.Box.of(sample.box))


def random_vectors(sample: Sample, seed: int) -> NDArray[np.float32]:
    return np.random.default_rng(seed).normal(size=sample.x.shape).astype(np.float32)


def assert_close(got: NDArray[np.float32], expected: Array, size: float | Array) -> None:
    """|got - expected| <= ROUNDINGS EPS size, elementwise; `size` may differ per particle."""
    assert got.dtype == np.float32
    assert got.shape == expected.shape
    bound = np.broadcast_to(ROUNDINGS * EPS * np.asarray(size), expected.shape)
    excess = np.abs(got - expected) - bound
    assert np.all(excess <= 0.0), f"row {np.argmax(excess) // max(1, got[:1].size)} is off"


# --- kernels, calibration, neighbors -------------------------------------------------------------


@each_fluid
def test_calibration_agrees(fluid: pbf.FluidParams) -> None:
    volume, ideal = stages.calibration(fluid)
    expected = ref.calibration(ref.Fluid.of(fluid))
    assert (volume, ideal) == pytest.approx(expected, rel=2 * EPS)  # computed in double, stored


@each_fluid
def test_kernels_agree(fluid: pbf.FluidParams) -> None:
    """To EPS of the largest value: near r = h the difference h - r has few digits left."""
    h = ref.Fluid.of(fluid).h
    direction = np.array([2.0, -1.0, 2.0]) / 3.0
    distances = np.concatenate([[0.0], np.geomspace(1e-4, 1.1, 200), [0.5, 0.999999, 1.0]]) * h
    r = (distances[:, None] * direction).astype(np.float32)
    W, grad_W = stages.kernel(fluid, r)
    W_exact, grad_exact = ref.kernel(ref.Fluid.of(fluid), r.astype(np.float64))
    assert_close(W, W_exact, W_exact.max() / 4)
    assert_close(grad_W, grad_exact, np.abs(grad_exact).max() / 4)
    np.testing.assert_array_equal(grad_W[0], 0.0)


@each_sample
@pytest.mark.parametrize("h", [1.5 * D, 2.0 * D, 2.5 * D, 4.0 * D])
def test_neighbor_pairs_are_those_of_brute_force(sample: Sample, h: float) -> None:
    """Pairs whose distance is h to within rounding may fall either way, all others may not."""
    i, j = stages.neighbor_pairs(sample.x, h)
    assert i.dtype == j.dtype == np.int64
    got = list(zip(i.tolist(), j.tolist(), strict=True))
    assert got == sorted(set(got)), "sorted, none twice"
    assert not np.any(i == j), "nobody neighbors itself"
    h_used = float(np.float32(h))
    x = exact(sample)
    surely = set(zip(*pairs_without_self(x, h_used * (1 - 4 * EPS)), strict=True))
    perhaps = set(zip(*pairs_without_self(x, h_used * (1 + 4 * EPS)), strict=True))
    assert surely <= set(got) <= perhaps


def pairs_without_self(x: Array, h: float) -> tuple[list[int], list[int]]:
    i, j = ref.pairs_within(x, x, h)
    others = i != j
    return i[others].tolist(), j[others].tolist()


@each_fluid
@each_sample
def test_boundary_particles_are_those_of_the_lattice_outside_the_box(
    fluid: pbf.FluidParams, sample: Sample
) -> None:
    offsets, q = stages.boundary_particles(sample.x, fluid, sample.box)
    assert len(offsets) == len(sample.x) + 1
    assert offsets[0] == 0
    assert offsets[-1] == len(q)
    exact_fluid, box = ref.Fluid.of(fluid), ref.Box.of(sample.box)
    lattice = np.empty((0, 3)) if box is None else ref.boundary_lattice(exact_fluid, box)
    for i, x in enumerate(exact(sample)):
        distance = np.linalg.norm(lattice - x, axis=1)
        surely = np.flatnonzero(distance < exact_fluid.h * (1 - 32 * EPS))
        perhaps = np.flatnonzero(distance < exact_fluid.h * (1 + 32 * EPS))
        row = q[offsets[i] : offsets[i + 1]].astype(np.float64)
        apart = np.linalg.norm(row[:, None] - lattice[perhaps], axis=2)
        found = perhaps[np.argmin(apart, axis=1)] if len(row) else np.empty(0, np.int64)
        assert len(set(found.tolist())) == len(row), "each once"
        assert set(surely.tolist()) <= set(found.tolist())
        # coordinates below 0.5 m: two roundings of at most 0.25 EPS m each
        assert np.all(np.abs(row - lattice[found]) <= 0.5 * EPS)


# --- prediction and the constraint ---------------------------------------------------------------


@each_sample
def test_prediction_agrees(sample: Sample) -> None:
    fluid = pbf.FluidParams(spacing=D, gravity=(1.0, -9.81, 2.0))
    v, dt = random_vectors(sample, 30), float(np.float32(0.004))
    got_v, got_x = stages.predict(sample.x, v, fluid, sample.box, dt)
    expected_v, expected_x = ref.predict(
        exact(sample), v.astype(np.float64), ref.Fluid.of(fluid), ref.Box.of(sample.box), dt
    )
    assert_close(got_v, expected_v, 5.0 / 16)  # speeds up to 5 m/s, four roundings
    assert_close(got_x, expected_x, 1.0 / 16)  # coordinates below 1 m, four roundings


@each_fluid
@each_solver
@each_sample
def test_densities_and_multipliers_agree(
    fluid: pbf.FluidParams, solver: pbf.SolverParams, sample: Sample
) -> None:
    """C is a difference of numbers near 1, so lambda is good to EPS (|C| + 1) / denominator."""
    densities, lambdas = stages.multipliers(sample.x, fluid, solver, sample.box)
    exact_fluid, exact_solver = ref.Fluid.of(fluid), ref.Solver.of(solver)
    near = near_of(sample, fluid)
    expected, expected_lambdas = ref.multipliers(exact(sample), near, exact_fluid, exact_solver)
    relative = expected / exact_fluid.rest_density
    assert_close(densities, expected, expected)
    C = np.abs(np.maximum(relative - 1.0, exact_solver.constraint_floor))
    _, ideal = ref.calibration(exact_fluid)
    with np.errstate(divide="ignore", invalid="ignore"):
        denominator = np.where(
            C > 0.0, C / np.abs(expected_lambdas), exact_solver.relaxation * ideal
        )
    assert_close(lambdas, expected_lambdas, (C + relative) / denominator)


@each_fluid
@each_solver
@each_sample
def test_corrections_agree(
    fluid: pbf.FluidParams, solver: pbf.SolverParams, sample: Sample
) -> None:
    """To EPS of the sum of the sizes of the terms, which cancel in a calm fluid."""
    exact_fluid, exact_solver = ref.Fluid.of(fluid), ref.Solver.of(solver)
    volume, ideal = ref.calibration(exact_fluid)
    near, x = near_of(sample, fluid), exact(sample)
    lambdas = (np.random.default_rng(31).normal(size=len(x)) * 0.1 / ideal).astype(np.float32)
    got = stages.corrections(sample.x, lambdas, fluid, solver, sample.box)
    expected = ref.corrections(x, lambdas.astype(np.float64), near, exact_fluid, exact_solver)

    _, grad_W_q = ref.kernel(exact_fluid, x[near.boundary_i] - near.q[near.boundary_k])
    at_dq = [[0.0, 0.0, 0.0], [exact_solver.tensile_distance * exact_fluid.h, 0.0, 0.0]]
    W, _ = ref.kernel(exact_fluid, np.array(at_dq))
    largest = exact_solver.tensile_strength / ideal * (W[0] / W[1]) ** exact_solver.tensile_exponent
    weight = 2 * np.abs(lambdas).max(initial=0.0) + largest
    walls = volume * near.sum_boundary(weight * np.linalg.norm(grad_W_q, axis=1))[:, None]
    ones = np.full(len(near.i), weight)
    assert_close(got, expected, terms_of(near, exact_fluid, x, ones) + walls)


@each_sample
def test_projection_is_exact(sample: Sample) -> None:
    thrown = sample.x + np.float32(0.05) * random_vectors(sample, 32)
    expected = ref.project(thrown.astype(np.float64), ref.Box.of(sample.box))
    got = stages.project(thrown, sample.box)
    assert got.dtype == np.float32
    np.testing.assert_array_equal(got, expected)


# --- velocities ----------------------------------------------------------------------------------


@each_fluid
@each_sample
def test_vorticity_agrees(fluid: pbf.FluidParams, sample: Sample) -> None:
    exact_fluid, near, x = ref.Fluid.of(fluid), near_of(sample, fluid), exact(sample)
    v = random_vectors(sample, 33)
    got = stages.vorticity(sample.x, v, fluid)
    expected = ref.vorticity(x, v.astype(np.float64), near, exact_fluid)
    assert_close(got, expected, terms_of(near, exact_fluid, x, speeds(v, near)))


@each_fluid
@each_sample
def test_vorticity_confinement_agrees(fluid: pbf.FluidParams, sample: Sample) -> None:
    """The direction N is good to EPS times the sizes of eta's terms over eta itself."""
    exact_fluid, near, x = ref.Fluid.of(fluid), near_of(sample, fluid), exact(sample)
    v, omega = random_vectors(sample, 34), random_vectors(sample, 35)
    strength, dt = 0.5, 0.125
    got = stages.confine(sample.x, v, omega, fluid, strength, dt)
    expected = ref.confine(
        x,
        v.astype(np.float64),
        omega.astype(np.float64),
        near,
        exact_fluid,
        strength=strength,
        dt=dt,
    )
    volume, _ = ref.calibration(exact_fluid)
    _, grad_W = ref.kernel(exact_fluid, x[near.i] - x[near.j])
    spin = np.linalg.norm(omega.astype(np.float64), axis=1)
    eta = np.linalg.norm(volume * near.sum(spin[near.j, None] * grad_W), axis=1)
    terms = terms_of(near, exact_fluid, x, spin[near.j])[:, 0]
    turned = np.divide(terms, eta, out=np.zeros_like(eta), where=eta > 0.0)
    size = np.linalg.norm(v, axis=1) + strength * dt * spin * (1.0 + turned)
    assert_close(got, expected, size[:, None])


@each_fluid
@each_sample
def test_viscosity_agrees(fluid: pbf.FluidParams, sample: Sample) -> None:
    exact_fluid, near, x = ref.Fluid.of(fluid), near_of(sample, fluid), exact(sample)
    v = random_vectors(sample, 36)
    got = stages.xsph(sample.x, v, fluid, 0.5)
    expected = ref.xsph(x, v.astype(np.float64), near, exact_fluid, 0.5)
    volume, _ = ref.calibration(exact_fluid)
    W, _ = ref.kernel(exact_fluid, x[near.i] - x[near.j])
    size = np.linalg.norm(v, axis=1) + 0.5 * volume * near.sum(W * speeds(v, near))
    assert_close(got, expected, size[:, None])


def speeds(v: NDArray[np.float32], near: ref.Neighbors) -> Array:
    return np.linalg.norm((v[near.j] - v[near.i]).astype(np.float64), axis=1)


def terms_of(near: ref.Neighbors, fluid: ref.Fluid, x: Array, weights: Array) -> Array:
    """V sum_j weight_ij |grad W_ij|, a column: the size of the terms of a sum over gradients.

    The kernel loses EPS h of h - r however little is left of it, which the last part stands for.
    """
    volume, _ = ref.calibration(fluid)
    _, grad_W = ref.kernel(fluid, x[near.i] - x[near.j])
    steepness = np.linalg.norm(grad_W, axis=1)
    _, at_half = ref.kernel(fluid, np.array([fluid.h / 2, 0.0, 0.0]))
    return volume * near.sum(weights * (steepness + np.abs(at_half[0]) / 8))[:, None]


# --- what no single number shows -----------------------------------------------------------------


@each_fluid
def test_corrections_without_walls_conserve_momentum(fluid: pbf.FluidParams) -> None:
    """|sum Delta p| <= 1e-6 sum |Delta p|: every pair's term is antisymmetric."""
    solver = SOLVERS["pushing, tensile"]
    for name in ("jittered, free surface", "compressed", "coincident"):
        x = SAMPLES[name].x
        _, lambdas = stages.multipliers(x, fluid, solver, None)
        dp = stages.corrections(x, lambdas, fluid, solver, None).astype(np.float64)
        total = np.linalg.norm(dp, axis=1).sum()
        assert total > 0.0
        assert np.linalg.norm(dp.sum(axis=0)) <= 1e-6 * total


@pytest.mark.parametrize("spacing", [1e-5, 1e-3, 1.0, 1e3, 1e5])
def test_the_solver_works_alike_at_every_scale(spacing: float) -> None:
    """lambda / d^2 and Delta p / d do not know the unit of length: nothing over- or underflows."""
    solver = SOLVERS["pushing, tensile"]
    unit = jittered_block(5, 1.0, seed=37, share=0.3)
    x = (spacing * unit).astype(np.float32)
    fluid = pbf.FluidParams(spacing=spacing)
    densities, lambdas = stages.multipliers(x, fluid, solver, None)
    dp = stages.corrections(x, lambdas, fluid, solver, None)

    exact_fluid, exact_solver = ref.Fluid.of(fluid), ref.Solver.of(solver)
    near = ref.find_neighbors(x.astype(np.float64), exact_fluid)
    expected, expected_lambdas = ref.multipliers(
        x.astype(np.float64), near, exact_fluid, exact_solver
    )
    np.testing.assert_allclose(densities, expected, rtol=ROUNDINGS * EPS)
    np.testing.assert_allclose(
        lambdas / spacing**2, expected_lambdas / spacing**2, atol=8 * ROUNDINGS * EPS
    )
    expected_dp = ref.corrections(
        x.astype(np.float64), expected_lambdas, near, exact_fluid, exact_solver
    )
    np.testing.assert_allclose(dp / spacing, expected_dp / spacing, atol=16 * ROUNDINGS * EPS)


def test_without_relaxation_particles_that_nothing_moves_have_no_multiplier() -> None:
    """A lone particle and two in one place have no gradient: 0 / 0 must not reach the state."""
    solver = pbf.SolverParams(relaxation=0.0, constraint_floor=-LOOSE)
    x = np.array([[0, 0, 0], [1, 0, 0], [1, 0, 0]], dtype=np.float32)
    _, lambdas = stages.multipliers(x, pbf.FluidParams(spacing=D), solver, None)
    np.testing.assert_array_equal(lambdas, 0.0)
