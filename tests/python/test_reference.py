"""The float64 reference against closed forms, finite differences and invariants.

No compiled code here: what the solver is measured against must itself stand on formulas.
"""

from __future__ import annotations

import math

import numpy as np
import pytest
import reference as ref
from numpy.typing import NDArray
from reference import operators
from reference.samples import bulk, jittered_block, lattice_block

Array = NDArray[np.float64]

KERNELS = ["poly6_spiky", "cubic_spline", "wendland"]
D = 0.1  # spacing [m] of the particle sets below
OPEN_SOLVER = ref.Solver(relaxation=0.0)


def fluid_of(kernel: str = "poly6_spiky", h_over_d: float = 2.0) -> ref.Fluid:
    return ref.Fluid(spacing=D, support_radius=h_over_d * D, kernel=kernel)


def radial(values: Array) -> Array:
    """Vectors of the given lengths along one fixed oblique direction."""
    return values[:, None] * (np.array([2.0, -1.0, 2.0]) / 3.0)


def gauss_points(lower: float, upper: float) -> tuple[Array, Array]:
    nodes, weights = np.polynomial.legendre.leggauss(16)  # exact up to degree 31
    return (upper - lower) / 2 * nodes + (upper + lower) / 2, (upper - lower) / 2 * weights


# --- kernels -------------------------------------------------------------------------------------


@pytest.mark.parametrize("kernel", KERNELS)
@pytest.mark.parametrize("h", [0.05, 1.0, 3.0])
def test_the_kernel_and_the_potential_of_its_gradient_integrate_to_one(
    kernel: str, h: float
) -> None:
    """4 pi int W r^2 dr = 1, and by parts -(4 pi / 3) int (r . grad W) r^2 dr = 1."""
    fluid = ref.Fluid(spacing=h / 2, support_radius=h, kernel=kernel)
    mass = gradient_mass = 0.0
    for lower, upper in [(0.0, h / 2), (h / 2, h)]:  # polynomials on each half
        r, weight = gauss_points(lower, upper)
        W, grad_W = ref.kernel(fluid, radial(r))
        mass += float(np.sum(weight * 4 * np.pi * r**2 * W))
        along = np.sum(radial(r) * grad_W, axis=1)
        gradient_mass -= float(np.sum(weight * 4 * np.pi / 3 * r**2 * along))
    assert mass == pytest.approx(1.0, rel=1e-12)
    assert gradient_mass == pytest.approx(1.0, rel=1e-12)


def test_the_cubic_spline_gradient_is_that_of_its_value() -> None:
    h, step = 0.7, 1e-6
    rng = np.random.default_rng(1)
    r = rng.uniform(-h, h, (200, 3))
    numeric = np.empty_like(r)
    for axis in range(3):
        shift = step * np.eye(3)[axis]
        rise = ref.cubic_spline(r + shift, h) - ref.cubic_spline(r - shift, h)
        numeric[:, axis] = rise / (2 * step)
    # central differences: step^2 W''' / 6, and W''' is of order 100 / h^6
    np.testing.assert_allclose(ref.cubic_spline_gradient(r, h), numeric, atol=1e-6)


def test_the_spiky_gradient_is_that_of_the_spiky_kernel() -> None:
    h, step = 0.7, 1e-6
    rng = np.random.default_rng(2)
    r = rng.uniform(-h, h, (200, 3))

    def spiky(r: Array) -> Array:
        distance = np.linalg.norm(r, axis=1)
        return np.asarray(15 / (np.pi * h**6) * np.maximum(h - distance, 0) ** 3)

    numeric = np.stack(
        [(spiky(r + e) - spiky(r - e)) / (2 * step) for e in step * np.eye(3)], axis=1
    )
    np.testing.assert_allclose(ref.spiky_gradient(r, h), numeric, atol=1e-6)


@pytest.mark.parametrize("kernel", KERNELS)
def test_kernels_are_even_end_at_h_and_have_no_gradient_at_the_center(kernel: str) -> None:
    fluid = ref.Fluid(spacing=0.5, support_radius=1.0, kernel=kernel)
    r = radial(np.array([0.0, 0.3, 0.5, 0.8, 1.0, 1.5]))
    W, grad_W = ref.kernel(fluid, r)
    W_mirror, grad_W_mirror = ref.kernel(fluid, -r)
    np.testing.assert_array_equal(W, W_mirror)
    np.testing.assert_array_equal(grad_W, -grad_W_mirror)
    np.testing.assert_array_equal(W[-2:], 0.0)
    np.testing.assert_array_equal(grad_W[-2:], 0.0)
    np.testing.assert_array_equal(grad_W[0], 0.0)
    assert np.all(np.sum(r * grad_W, axis=1)[1:-2] < 0.0)  # W falls with distance


# --- calibration and walls -----------------------------------------------------------------------


def test_calibration_has_the_known_values_at_twice_the_spacing() -> None:
    """sum W d^3 = 1.010 for poly6 and 1.000 for the cubic spline; D_ideal is about 0.37 / d^2."""
    volume, ideal = ref.calibration(fluid_of("poly6_spiky"))
    assert D**3 / volume == pytest.approx(1.010, abs=5e-4)
    assert ideal * D**2 == pytest.approx(0.37, abs=5e-3)
    volume, _ = ref.calibration(fluid_of("cubic_spline"))
    assert D**3 / volume == pytest.approx(1.000, abs=5e-4)


@pytest.mark.parametrize("kernel", KERNELS)
@pytest.mark.parametrize("h_over_d", [1.5, 2.0, 2.5])
def test_a_lattice_has_its_rest_density_and_ideal_denominator_inside(
    kernel: str, h_over_d: float
) -> None:
    fluid = fluid_of(kernel, h_over_d)
    x = lattice_block(7, D)
    near = ref.find_neighbors(x, fluid)
    inside = bulk(x, D, fluid.h)
    assert inside.any()
    densities, _ = ref.multipliers(x, near, fluid, OPEN_SOLVER)
    np.testing.assert_allclose(densities[inside], fluid.rest_density, rtol=1e-12)

    # Scaling C to -1 by the density alone leaves lambda = -C / D: read D off a denser fluid.
    volume, ideal = ref.calibration(fluid)
    _, grad_W = ref.kernel(fluid, x[near.i] - x[near.j])
    denominator = near.sum(np.sum((volume * grad_W) ** 2, axis=1))
    np.testing.assert_allclose(denominator[inside], ideal, rtol=1e-12)


@pytest.mark.parametrize("kernel", KERNELS)
@pytest.mark.parametrize("h_over_d", [1.5, 2.0, 2.5])
def test_a_lattice_that_fills_its_box_is_at_rest_up_to_the_walls(
    kernel: str, h_over_d: float
) -> None:
    """The boundary particles continue the lattice, so C = 0 and no correction, corners included."""
    fluid = fluid_of(kernel, h_over_d)
    box = ref.Box(np.zeros(3), np.array([4 * D, 3 * D, 5 * D]))
    axes = [D * (np.arange(n) + 0.5) for n in (4, 3, 5)]
    x = np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1).reshape(-1, 3)
    solver = ref.Solver(relaxation=0.0, tensile_strength=0.1)
    near = ref.find_neighbors(x, fluid, box)
    densities, lambdas = ref.multipliers(x, near, fluid, solver)
    np.testing.assert_allclose(densities, fluid.rest_density, rtol=1e-12)
    assert np.abs(ref.corrections(x, lambdas, near, fluid, solver)).max() < 1e-12 * D


def test_boundary_particles_stand_half_a_spacing_outside_and_fill_the_support_radius() -> None:
    fluid = fluid_of(h_over_d=2.5)  # ceil(2.5) = 3 layers
    box = ref.Box(np.array([0.2, -0.3, 1.0]), np.array([0.2 + 4.3 * D, 0.0, 1.0 + 0.4 * D]))
    q = ref.boundary_lattice(fluid, box)
    cells = np.array([4, 3, 1])  # round(4.3), round(3), at least one
    assert len(q) == np.prod(cells + 6) - np.prod(cells)
    outside = np.maximum(box.lower - q, q - box.upper).max(axis=1)
    depths = np.unique(np.round(outside / D, 9))
    np.testing.assert_allclose(depths, [0.5, 1.5, 2.5])


def test_the_centers_of_particles_keep_their_radius_from_the_walls() -> None:
    box = ref.Box(np.zeros(3), np.array([1.0, 2.0, 3.0]))
    inner = ref.centers(fluid_of(), box)
    assert inner is not None
    np.testing.assert_allclose(inner.lower, np.full(3, D / 2))
    np.testing.assert_allclose(inner.upper, np.array([1.0, 2.0, 3.0]) - D / 2)
    assert ref.centers(fluid_of(), None) is None


def test_projection_goes_to_the_nearest_point_of_the_closed_box() -> None:
    box = ref.Box(np.zeros(3), np.array([1.0, 2.0, 3.0]))
    x = np.array([[-1.0, 1.0, 4.0], [0.5, 2.5, 1.0], [1.0, 2.0, 0.0], [0.2, 0.3, 0.4]])
    expected = [[0.0, 1.0, 3.0], [0.5, 2.0, 1.0], [1.0, 2.0, 0.0], [0.2, 0.3, 0.4]]
    np.testing.assert_array_equal(ref.project(x, box), expected)
    np.testing.assert_array_equal(ref.project(x, None), x)


# --- the constraint ------------------------------------------------------------------------------


def test_the_multiplier_uses_the_gradient_of_the_constraint() -> None:
    """With one kernel for both, sum_k |grad_k C_i|^2 follows from C alone by differences."""
    fluid = fluid_of("cubic_spline")
    box = ref.Box(np.zeros(3), np.full(3, 3 * D))
    x = jittered_block(3, D, seed=3)[:20]
    rest = fluid.rest_density

    def C(positions: Array) -> Array:
        near = ref.find_neighbors(positions, fluid, box)
        return ref.multipliers(positions, near, fluid, OPEN_SOLVER)[0] / rest - 1.0

    step = 1e-6 * D
    denominator = np.zeros(len(x))
    for k in range(len(x)):
        for axis in range(3):
            shift = np.zeros_like(x)
            shift[k, axis] = step
            denominator += ((C(x + shift) - C(x - shift)) / (2 * step)) ** 2

    near = ref.find_neighbors(x, fluid, box)
    _, lambdas = ref.multipliers(x, near, fluid, OPEN_SOLVER)
    np.testing.assert_allclose(lambdas, -C(x) / denominator, rtol=1e-6)


@pytest.mark.parametrize("kernel", KERNELS)
def test_two_particles_have_the_multiplier_and_correction_worked_out_by_hand(kernel: str) -> None:
    fluid = fluid_of(kernel)
    solver = ref.Solver(relaxation=0.3, tensile_strength=0.2, tensile_distance=0.25)
    r = np.array([0.6 * D, 0.0, 0.0])
    x = np.stack([r, np.zeros(3)])
    volume, ideal = ref.calibration(fluid)
    W, grad_W = ref.kernel(fluid, r)
    W_0, _ = ref.kernel(fluid, np.zeros(3))
    W_dq, _ = ref.kernel(fluid, np.array([0.25 * fluid.h, 0.0, 0.0]))
    C = volume * (W_0 + W) - 1.0
    lam = -C / (2.0 * volume**2 * (grad_W @ grad_W) + 0.3 * ideal)
    s = -0.2 / ideal * (W / W_dq) ** 4
    dp = volume * (2.0 * lam + s) * grad_W

    near = ref.find_neighbors(x, fluid)
    densities, lambdas = ref.multipliers(x, near, fluid, solver)
    np.testing.assert_allclose(densities, fluid.rest_density * (C + 1.0), rtol=1e-14)
    np.testing.assert_allclose(lambdas, [lam, lam], rtol=1e-14)
    np.testing.assert_allclose(
        ref.corrections(x, lambdas, near, fluid, solver), [dp, -dp], rtol=1e-13, atol=1e-18
    )


def test_the_floor_of_zero_only_pushes_and_minus_infinity_also_pulls() -> None:
    fluid = fluid_of()
    apart = np.array([[1.5 * D, 0.0, 0.0], [0.0, 0.0, 0.0]])  # far too thin: C < 0
    near = ref.find_neighbors(apart, fluid)
    for floor, moves in [(0.0, False), (-math.inf, True)]:
        solver = ref.Solver(constraint_floor=floor)
        densities, lambdas = ref.multipliers(apart, near, fluid, solver)
        dp = ref.corrections(apart, lambdas, near, fluid, solver)
        assert np.all(densities < fluid.rest_density)
        assert bool(np.any(dp)) is moves
        if moves:
            assert dp[0, 0] < 0.0 < dp[1, 0]  # together


def test_an_iteration_pushes_compressed_particles_apart_and_lowers_the_density_error() -> None:
    fluid = fluid_of()
    solver = ref.Solver(constraint_floor=0.0)
    x = 0.95 * jittered_block(5, D, seed=4)
    near = ref.find_neighbors(x, fluid)
    densities, lambdas = ref.multipliers(x, near, fluid, solver)
    moved = x + ref.corrections(x, lambdas, near, fluid, solver)
    after, _ = ref.multipliers(moved, near, fluid, solver)
    excess = np.maximum(densities / fluid.rest_density - 1.0, 0.0).mean()
    assert np.maximum(after / fluid.rest_density - 1.0, 0.0).mean() < 0.8 * excess


def test_the_artificial_repulsion_pushes_apart() -> None:
    fluid = fluid_of()
    x = np.array([[0.5 * D, 0.0, 0.0], [0.0, 0.0, 0.0]])
    near = ref.find_neighbors(x, fluid)
    dp = ref.corrections(x, np.zeros(2), near, fluid, ref.Solver(tensile_strength=0.1))
    assert dp[0, 0] > 0.0 > dp[1, 0]


@pytest.mark.parametrize("kernel", KERNELS)
def test_corrections_and_viscosity_conserve_momentum_without_walls(kernel: str) -> None:
    fluid = fluid_of(kernel)
    solver = ref.Solver(tensile_strength=0.1)
    x = jittered_block(6, D, seed=5, share=0.4)
    v = np.random.default_rng(6).normal(size=x.shape)
    near = ref.find_neighbors(x, fluid)
    _, lambdas = ref.multipliers(x, near, fluid, solver)
    dp = ref.corrections(x, lambdas, near, fluid, solver)
    assert np.linalg.norm(dp.sum(0)) <= 1e-13 * np.linalg.norm(dp, axis=1).sum()
    change = ref.xsph(x, v, near, fluid, 0.1) - v
    assert np.linalg.norm(change.sum(0)) <= 1e-13 * np.linalg.norm(change, axis=1).sum()


def test_the_multipliers_mean_the_same_at_every_resolution() -> None:
    """x -> s x takes lambda to s^2 lambda and Delta p to s Delta p: no hidden length."""
    solver = ref.Solver(relaxation=0.2, tensile_strength=0.1)
    unit = jittered_block(4, D, seed=7, share=0.3)
    results = []
    for scale in (1.0, 0.01):
        fluid = ref.Fluid(spacing=scale * D)
        near = ref.find_neighbors(scale * unit, fluid)
        _, lambdas = ref.multipliers(scale * unit, near, fluid, solver)
        dp = ref.corrections(scale * unit, lambdas, near, fluid, solver)
        results.append((lambdas / scale**2, dp / scale))
    np.testing.assert_allclose(results[1][0], results[0][0], rtol=1e-9)
    np.testing.assert_allclose(results[1][1], results[0][1], rtol=1e-9, atol=1e-12 * D)


# --- after the solve -----------------------------------------------------------------------------


@pytest.mark.parametrize("kernel", KERNELS)
def test_rigid_rotation_has_twice_its_rate_as_vorticity_in_the_bulk(kernel: str) -> None:
    """Exactly 2 Omega times M, the first moment of the kernel on the lattice (0.95 and 1.02)."""
    fluid = fluid_of(kernel)
    x = lattice_block(7, D)
    rate = np.array([0.3, -0.5, 1.0])
    near = ref.find_neighbors(x, fluid)
    omega = ref.vorticity(x, np.cross(rate, x), near, fluid)[bulk(x, D, fluid.h)]
    volume, _ = ref.calibration(fluid)
    M = operators.moment(x, fluid, volume)[len(x) // 2, 0, 0]
    np.testing.assert_allclose(omega, np.broadcast_to(2 * M * rate, omega.shape), rtol=1e-12)
    assert abs(M - 1.0) < 0.06


def test_confinement_spins_an_eddy_up_and_leaves_uniform_rotation_alone() -> None:
    """N points to the eddy's core, N x omega along its flow; |gain| = dt strength |omega|."""
    fluid = fluid_of()
    x = lattice_block(11, D)
    near = ref.find_neighbors(x, fluid)
    inside = bulk(x, D, 2 * fluid.h)
    arm = (x - x.mean(0)) * [1.0, 1.0, 0.0]
    rigid = np.cross([0.0, 0.0, 1.0], arm)
    eddy = rigid * np.exp(-np.sum((arm / D) ** 2, axis=1) / 8)[:, None]

    omega = ref.vorticity(x, rigid, near, fluid)
    np.testing.assert_array_equal(
        ref.confine(x, rigid, omega, near, fluid, strength=1.0, dt=1.0)[inside], rigid[inside]
    )

    omega = ref.vorticity(x, eddy, near, fluid)
    gain = ref.confine(x, eddy, omega, near, fluid, strength=2.0, dt=0.01) - eddy
    around = inside & (np.linalg.norm(arm, axis=1) > D / 2)
    size = np.linalg.norm(gain[around], axis=1)
    np.testing.assert_allclose(size, 0.02 * np.linalg.norm(omega[around], axis=1), rtol=1e-9)
    along = np.sum(gain * rigid, axis=1)[around] / np.linalg.norm(rigid[around], axis=1)
    np.testing.assert_allclose(along, size, rtol=1e-9)


def test_viscosity_gathers_old_velocities_and_calms_them() -> None:
    fluid = fluid_of()
    x = np.array([[0.0, 0.0, 0.0], [0.5 * D, 0.0, 0.0]])
    v = np.array([[1.0, 0.0, 0.0], [-1.0, 0.0, 0.0]])
    near = ref.find_neighbors(x, fluid)
    volume, _ = ref.calibration(fluid)
    W, _ = ref.kernel(fluid, x[0] - x[1])
    exchanged = 0.5 * volume * W * 2.0
    expected = [[1.0 - exchanged, 0.0, 0.0], [-1.0 + exchanged, 0.0, 0.0]]
    np.testing.assert_allclose(ref.xsph(x, v, near, fluid, 0.5), expected, rtol=1e-14)


def test_a_lone_particle_follows_the_recurrence_of_free_fall() -> None:
    fluid, dt = fluid_of(), 0.01
    state = ref.State.at(np.array([[0.0, 10.0, 0.0]]), np.array([[1.0, 2.0, 3.0]]))
    for _ in range(50):
        state = ref.step(state, fluid, ref.Solver(), None, dt)
    g, t = np.array(fluid.gravity), 50 * dt
    np.testing.assert_allclose(state.v[0], [1.0, 2.0, 3.0] + g * t, rtol=1e-11)
    # symplectic Euler: x_n = x_0 + t v_0 + g dt^2 n (n + 1) / 2
    expected = [0.0, 10.0, 0.0] + t * np.array([1.0, 2.0, 3.0]) + g * dt**2 * 50 * 51 / 2
    np.testing.assert_allclose(state.x[0], expected, rtol=1e-11)


def test_a_step_conserves_momentum_in_open_space_and_stays_in_a_box() -> None:
    fluid = ref.Fluid(spacing=D, gravity=(0.0, 0.0, 0.0))
    solver = ref.Solver(constraint_floor=0.0, tensile_strength=0.05, xsph=0.1)
    x = jittered_block(5, D, seed=8)
    v = np.random.default_rng(9).normal(size=x.shape)
    state = ref.State.at(x, v)
    for _ in range(5):
        state = ref.step(state, fluid, solver, None, 0.01)
    np.testing.assert_allclose(state.v.sum(0), v.sum(0), atol=1e-11 * np.abs(v).sum())

    box = ref.Box(np.zeros(3), np.full(3, 5 * D))
    state = ref.State.at(ref.project(x, box), 20.0 * v)
    for _ in range(5):
        state = ref.step(state, fluid, solver, box, 0.01)
        assert np.all((state.x >= box.lower) & (state.x <= box.upper))


# --- field operators -----------------------------------------------------------------------------


def linear_fields(x: Array) -> tuple[Array, Array, Array, Array]:
    """A scalar and a vector field that are linear, with their constant gradient and Jacobian."""
    slope = np.array([1.0, -2.0, 0.5])
    J = np.array([[0.2, 1.0, -0.3], [0.7, -0.4, 2.0], [-1.1, 0.6, 0.9]])
    return 3.0 + x @ slope, [1.0, 2.0, 3.0] + x @ J.T, slope, J


@pytest.mark.parametrize("kernel", KERNELS)
@pytest.mark.parametrize("h_over_d", [1.5, 2.0, 2.5])
def test_corrected_operators_are_exact_for_linear_fields_up_to_the_free_surface(
    kernel: str, h_over_d: float
) -> None:
    fluid = fluid_of(kernel, h_over_d)
    x = jittered_block(5, D, seed=10, share=0.1)
    volume, _ = ref.calibration(fluid)
    scalar, vector, slope, J = linear_fields(x)
    n = len(x)
    gradient = operators.gradient(scalar, x, fluid, volume, corrected=True)
    np.testing.assert_allclose(gradient, np.tile(slope, (n, 1)), rtol=1e-9, atol=1e-10)
    jacobian = operators.jacobian(vector, x, fluid, volume, corrected=True)
    np.testing.assert_allclose(jacobian, np.tile(J, (n, 1, 1)), rtol=1e-9, atol=1e-10)
    divergence = operators.divergence(vector, x, fluid, volume, corrected=True)
    np.testing.assert_allclose(divergence, np.full(n, np.trace(J)), rtol=1e-9)
    curl = operators.curl(vector, x, fluid, volume, corrected=True)
    expected = [J[2, 1] - J[1, 2], J[0, 2] - J[2, 0], J[1, 0] - J[0, 1]]
    np.testing.assert_allclose(curl, np.tile(expected, (n, 1)), rtol=1e-9, atol=1e-10)


@pytest.mark.parametrize(
    ("kernel", "h_over_d", "off"),
    [
        ("poly6_spiky", 2.0, 0.053),
        ("poly6_spiky", 2.5, 0.046),
        ("poly6_spiky", 3.0, 0.013),
        ("cubic_spline", 2.0, 0.021),
        ("cubic_spline", 3.0, 0.009),
    ],
)
def test_plain_operators_miss_linear_fields_by_the_first_moment_of_the_lattice(
    kernel: str, h_over_d: float, off: float
) -> None:
    """In the bulk M is a multiple of I, and plain results are M times the true ones."""
    fluid = fluid_of(kernel, h_over_d)
    x = lattice_block(7, D)
    volume, _ = ref.calibration(fluid)
    scalar, vector, slope, J = linear_fields(x)
    inside = bulk(x, D, fluid.h)
    moment = operators.moment(x, fluid, volume)[inside]
    M = moment[0, 0, 0]
    np.testing.assert_allclose(moment, np.tile(M * np.eye(3), (len(moment), 1, 1)), atol=1e-13)
    assert abs(M - 1.0) < off
    gradient = operators.gradient(scalar, x, fluid, volume)[inside]
    np.testing.assert_allclose(gradient, np.tile(M * slope, (len(gradient), 1)), atol=1e-12)
    jacobian = operators.jacobian(vector, x, fluid, volume)[inside]
    np.testing.assert_allclose(jacobian, np.tile(M * J, (len(jacobian), 1, 1)), atol=1e-12)


@pytest.mark.parametrize("kernel", KERNELS)
def test_the_curl_is_the_solvers_vorticity(kernel: str) -> None:
    fluid = fluid_of(kernel)
    x = jittered_block(5, D, seed=11)
    v = np.random.default_rng(12).normal(size=x.shape)
    volume, _ = ref.calibration(fluid)
    omega = ref.vorticity(x, v, ref.find_neighbors(x, fluid), fluid)
    np.testing.assert_allclose(operators.curl(v, x, fluid, volume), omega, atol=1e-11)


def test_curls_have_no_divergence_and_gradients_no_curl() -> None:
    fluid = fluid_of()
    x = lattice_block(9, D)
    volume, _ = ref.calibration(fluid)
    inside = bulk(x, D, 2 * fluid.h)
    wave = np.sin(4.0 * x[:, [1, 2, 0]])
    scalar = np.sin(3.0 * x[:, 0]) * np.cos(2.0 * x[:, 1]) + x[:, 2] ** 2
    # On a lattice the differences along two axes commute, so both vanish to rounding.
    div_curl = operators.divergence(operators.curl(wave, x, fluid, volume), x, fluid, volume)
    assert np.abs(div_curl[inside]).max() < 1e-10
    curl_grad = operators.curl(operators.gradient(scalar, x, fluid, volume), x, fluid, volume)
    assert np.abs(curl_grad[inside]).max() < 1e-10


@pytest.mark.parametrize(
    ("kernel", "h_over_d", "off"),
    [("poly6_spiky", 2.0, 0.08), ("poly6_spiky", 3.0, 0.05), ("cubic_spline", 2.0, 0.01)],
)
def test_the_laplacian_of_the_squared_distance_is_six_in_the_bulk(
    kernel: str, h_over_d: float, off: float
) -> None:
    """6 in the continuum; the lattice sum and the 0.01 h^2 in the denominator take the rest."""
    fluid = fluid_of(kernel, h_over_d)
    x = lattice_block(7, D)
    volume, _ = ref.calibration(fluid)
    inside = bulk(x, D, fluid.h)
    got = operators.laplacian(np.sum(x**2, axis=1), x, fluid, volume)[inside]
    np.testing.assert_allclose(got, 6.0, rtol=off)
    linear = operators.laplacian(linear_fields(x)[0], x, fluid, volume)[inside]
    assert np.abs(linear).max() < 1e-10


def test_corrected_operators_converge_with_the_square_of_the_spacing() -> None:
    errors = []
    for d in (0.1, 0.05, 0.025):
        fluid = ref.Fluid(spacing=d)
        x = ref.lattice(d, 3 * d) + 0.3  # a patch about one point is all the local formula needs
        volume, _ = ref.calibration(fluid)
        center = len(x) // 2
        scalar = np.sin(2 * x[:, 0]) * np.cos(x[:, 1]) + np.sin(x[:, 2])
        vector = np.sin(x[:, [1, 2, 0]] * [2.0, 1.0, 3.0])
        X, Y, Z = x[center]
        exact = [2 * np.cos(2 * X) * np.cos(Y), -np.sin(2 * X) * np.sin(Y), np.cos(Z)]
        curl = [-np.cos(Z), -3 * np.cos(3 * X), -2 * np.cos(2 * Y)]
        got = operators.gradient(scalar, x, fluid, volume, corrected=True)[center]
        got_curl = operators.curl(vector, x, fluid, volume, corrected=True)[center]
        errors.append([np.abs(got - exact).max(), np.abs(got_curl - curl).max()])
    ratios = np.array(errors[:-1]) / np.array(errors[1:])
    np.testing.assert_allclose(ratios, 4.0, rtol=0.05)


def test_density_is_one_in_the_bulk_and_the_lone_particles_share_alone() -> None:
    fluid = fluid_of()
    volume, _ = ref.calibration(fluid)
    x = np.vstack([lattice_block(5, D), [[100.0, 0.0, 0.0]]])
    got = operators.density(x, fluid, volume)
    inside = bulk(lattice_block(5, D), D, fluid.h)
    np.testing.assert_allclose(got[:-1][inside], 1.0, rtol=1e-12)
    W_0, _ = ref.kernel(fluid, np.zeros(3))
    assert got[-1] == pytest.approx(float(volume * W_0), rel=1e-14)
