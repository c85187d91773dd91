"""The public field operators against the float64 reference and against analytic fields."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
import reference as ref
from numpy.typing import NDArray
from reference.samples import bulk, jittered_block, lattice_block

import pbfluids as pbf
from pbfluids import errors

EPS = float(np.finfo(np.float32).eps)
D = 0.1  # spacing [m]
H = 2 * D  # support radius [m]
KERNELS = ["poly6_spiky", "cubic_spline"]
FIELDS = ["gradient", "jacobian", "divergence", "curl", "laplacian"]

each_kernel = pytest.mark.parametrize("kernel", KERNELS)


def as_float32(x: NDArray[np.float64]) -> NDArray[np.float64]:
    """Numbers that float32 holds exactly: both sides then see the same."""
    return x.astype(np.float32).astype(np.float64)


def reference_fluid(kernel: str, h: float = H) -> ref.Fluid:
    """The operators' volume is by default that of the rest lattice of spacing h/2."""
    h = float(np.float32(h))
    return ref.Fluid(spacing=h / 2, support_radius=h, kernel=kernel)


def smooth_fields(x: NDArray[np.float64]) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """A scalar and a vector field of order 1 with waves of about 10 D."""
    scalar = np.sin(5 * x[:, 0]) * np.cos(4 * x[:, 1]) + np.sin(6 * x[:, 2])
    return as_float32(scalar), as_float32(np.sin(x[:, [1, 2, 0]] * [5.0, 3.0, 6.0]))


def value_for(operator: str, x: NDArray[np.float64]) -> NDArray[np.float64]:
    scalar, vector = smooth_fields(x)
    return scalar if operator in {"gradient", "laplacian"} else vector


def call(operator: str, x: NDArray[np.float64], **options: Any) -> NDArray[np.float32]:
    """The plain sum, unless options say otherwise."""
    function: Callable[..., NDArray[np.float32]] = getattr(pbf.operators, operator)
    if operator != "laplacian":
        options.setdefault("corrected", False)
    return function(value_for(operator, x), x, support_radius=H, **options)


# --- against the reference -----------------------------------------------------------------------


@each_kernel
@pytest.mark.parametrize("volume", [None, 0.8 * D**3])
@pytest.mark.parametrize("operator", FIELDS)
def test_plain_operators_agree_with_the_reference(
    operator: str, kernel: str, volume: float | None
) -> None:
    """Sums of up to 40 terms of size 1/D (1/D^2 for the Laplacian), each a few roundings off."""
    x = as_float32(jittered_block(6, D, seed=50, share=0.3))
    fluid = reference_fluid(kernel)
    used = ref.calibration(fluid)[0] if volume is None else volume
    expected = getattr(ref.operators, operator)(value_for(operator, x), x, fluid, used)
    got = call(operator, x, kernel=kernel, volume=volume)
    assert got.dtype == np.float32
    size = 1 / D**2 if operator == "laplacian" else 1 / D
    np.testing.assert_allclose(got, expected, rtol=0, atol=32 * EPS * size)


@each_kernel
@pytest.mark.parametrize("operator", ["gradient", "jacobian", "divergence", "curl"])
def test_corrected_operators_agree_with_the_reference(operator: str, kernel: str) -> None:
    """The inverse of M amplifies roundings by its condition number, up to 30 at corners."""
    x = as_float32(jittered_block(6, D, seed=51, share=0.2))
    fluid = reference_fluid(kernel)
    volume, _ = ref.calibration(fluid)
    assert np.linalg.cond(ref.operators.moment(x, fluid, volume)).max() < 30
    values = value_for(operator, x)
    expected = getattr(ref.operators, operator)(values, x, fluid, volume, corrected=True)
    got = call(operator, x, kernel=kernel, corrected=True)
    np.testing.assert_allclose(got, expected, rtol=0, atol=30 * 32 * EPS / D)


@each_kernel
def test_density_agrees_with_the_reference(kernel: str) -> None:
    x = as_float32(jittered_block(6, D, seed=52, share=0.3))
    fluid = reference_fluid(kernel)
    expected = ref.operators.density(x, fluid, ref.calibration(fluid)[0])
    got = pbf.operators.density(x, support_radius=H, rest_density=1000.0, kernel=kernel)
    np.testing.assert_allclose(got, 1000.0 * expected, rtol=16 * EPS)


# --- against analytic fields ---------------------------------------------------------------------


@each_kernel
def test_corrected_operators_are_exact_for_linear_fields_up_to_the_free_surface(
    kernel: str,
) -> None:
    """Exact but for float32: values of size 2 over distances of D, through a condition of 30."""
    x = jittered_block(6, D, seed=53, share=0.1)
    slope = np.array([1.0, -2.0, 0.5])
    J = np.array([[0.2, 1.0, -0.3], [0.7, -0.4, 2.0], [-1.1, 0.6, 0.9]])
    options: dict[str, Any] = {"support_radius": H, "kernel": kernel, "corrected": True}
    close: dict[str, Any] = {"rtol": 0, "atol": 30 * 16 * EPS / D}
    n = len(x)
    gradient = pbf.operators.gradient(3 + x @ slope, x, **options)
    np.testing.assert_allclose(gradient, np.tile(slope, (n, 1)), **close)
    jacobian = pbf.operators.jacobian(x @ J.T, x, **options)
    np.testing.assert_allclose(jacobian, np.tile(J, (n, 1, 1)), **close)
    divergence = pbf.operators.divergence(x @ J.T, x, **options)
    np.testing.assert_allclose(divergence, np.full(n, np.trace(J)), **close)
    curl = pbf.operators.curl(x @ J.T, x, **options)
    expected = [J[2, 1] - J[1, 2], J[0, 2] - J[2, 0], J[1, 0] - J[0, 1]]
    np.testing.assert_allclose(curl, np.tile(expected, (n, 1)), **close)


@each_kernel
@pytest.mark.parametrize("operator", FIELDS)
def test_constants_have_no_derivative_anywhere(operator: str, kernel: str) -> None:
    x = jittered_block(5, D, seed=54)
    values = (
        np.full(len(x), 7.0) if operator in {"gradient", "laplacian"} else np.full(x.shape, 7.0)
    )
    got = getattr(pbf.operators, operator)(values, x, support_radius=H, kernel=kernel)
    np.testing.assert_array_equal(got, 0.0)


@pytest.mark.parametrize(("kernel", "off"), [("poly6_spiky", 0.08), ("cubic_spline", 0.01)])
def test_the_laplacian_of_the_squared_distance_is_six_in_the_bulk(kernel: str, off: float) -> None:
    """The lattice sum and the 0.01 h^2 in the denominator take the rest."""
    x = lattice_block(7, D)
    inside = bulk(x, D, H)
    got = pbf.operators.laplacian(np.sum(x**2, axis=1), x, support_radius=H, kernel=kernel)
    np.testing.assert_allclose(got[inside], 6.0, rtol=off)


@pytest.mark.parametrize(("kernel", "off"), [("poly6_spiky", 0.054), ("cubic_spline", 0.021)])
def test_the_curl_of_a_rigid_rotation_is_twice_its_rate_in_the_bulk(
    kernel: str, off: float
) -> None:
    """Plain: times the lattice's first moment, 0.947 and 1.020. Corrected: 2 Omega everywhere."""
    x = lattice_block(7, D)
    rate = np.array([0.3, -0.5, 1.0])
    v = np.cross(rate, x)
    plain = pbf.operators.curl(v, x, support_radius=H, kernel=kernel, corrected=False)[
        bulk(x, D, H)
    ]
    np.testing.assert_allclose(plain, np.tile(2 * rate, (len(plain), 1)), rtol=off)
    corrected = pbf.operators.curl(v, x, support_radius=H, kernel=kernel)
    np.testing.assert_allclose(corrected, np.tile(2 * rate, (len(x), 1)), atol=1e-4)


def test_corrected_gradients_converge_with_the_square_of_the_support_radius() -> None:
    """Halving h quarters the error; float32 stops it near EPS / D, far below these errors."""
    errors_seen = []
    for d in (0.1, 0.05, 0.025):
        x = ref.lattice(d, 3 * d) + 0.3
        center = len(x) // 2
        X, Y, Z = x[center]
        scalar = np.sin(2 * x[:, 0]) * np.cos(x[:, 1]) + np.sin(x[:, 2])
        exact = [2 * np.cos(2 * X) * np.cos(Y), -np.sin(2 * X) * np.sin(Y), np.cos(Z)]
        got = pbf.operators.gradient(scalar, x, support_radius=2 * d, corrected=True)[center]
        errors_seen.append(np.abs(got - exact).max())
    ratios = np.array(errors_seen[:-1]) / np.array(errors_seen[1:])
    np.testing.assert_allclose(ratios, 4.0, rtol=0.1)


# --- where the correction has nothing to invert --------------------------------------------------


@pytest.mark.parametrize(
    "x",
    [
        np.zeros((0, 3)),
        np.zeros((1, 3)),
        np.zeros((5, 3)),
        D * np.array([[0, 0, 0], [1, 0, 0], [2, 0, 0], [3, 0, 0]]),
        D * np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [1, 1, 0], [2, 1, 0]]),
    ],
    ids=["none", "one", "all in one place", "in a line", "in a plane"],
)
@pytest.mark.parametrize("operator", ["gradient", "jacobian", "divergence", "curl"])
def test_corrected_equals_plain_where_neighbors_do_not_span_space(
    operator: str, x: NDArray[np.float64]
) -> None:
    plain, corrected = call(operator, x), call(operator, x, corrected=True)
    assert np.all(np.isfinite(corrected))
    np.testing.assert_array_equal(corrected, plain)


# --- shapes, threads, errors ---------------------------------------------------------------------


def test_results_have_the_documented_shapes() -> None:
    x = jittered_block(3, D, seed=55)
    shapes = {operator: call(operator, x).shape for operator in FIELDS}
    assert shapes == {
        "gradient": (27, 3),
        "jacobian": (27, 3, 3),
        "divergence": (27,),
        "curl": (27, 3),
        "laplacian": (27,),
    }
    assert pbf.operators.density(x, support_radius=H).shape == (27,)


@pytest.mark.parametrize("operator", [*FIELDS, "density"])
def test_results_have_the_same_bits_for_any_number_of_threads(operator: str) -> None:
    x = jittered_block(14, D, seed=56, share=0.3)

    def bits(threads: int) -> bytes:
        if operator == "density":
            return pbf.operators.density(x, support_radius=H, num_threads=threads).tobytes()
        return call(operator, x, num_threads=threads).tobytes()

    once = bits(1)
    assert all(bits(threads) == once for threads in (2, 3, 4, 7, 16, 0))


def test_particles_may_come_in_any_order() -> None:
    """Row i of the result belongs to row i of the positions, which are sorted by cell inside."""
    x = jittered_block(6, D, seed=57)
    order = np.random.default_rng(58).permutation(len(x))
    for operator in FIELDS:
        in_order, shuffled = call(operator, x), call(operator, x[order])
        size = np.abs(in_order).max()
        np.testing.assert_allclose(shuffled, in_order[order], rtol=0, atol=32 * EPS * size)


@pytest.mark.parametrize(
    ("changes", "named"),
    [
        ({"support_radius": 0.0}, "support_radius"),
        ({"support_radius": -1.0}, "support_radius"),
        ({"support_radius": float("nan")}, "support_radius"),
        ({"support_radius": 0.9e-6}, "support_radius"),
        ({"support_radius": 1.1e6}, "support_radius"),
        ({"volume": 0.0}, "volume"),
        ({"volume": -1.0}, "volume"),
        ({"volume": float("inf")}, "volume"),
        ({"kernel": "gauss"}, "kernel"),
        ({"num_threads": -1}, "num_threads"),
        ({"num_threads": 1000}, "num_threads"),
        ({"values": np.zeros(7)}, "values"),
        ({"values": np.zeros((8, 3))}, "values"),
        ({"values": np.full(8, np.nan)}, "values"),
        ({"positions": np.zeros((8, 2))}, "positions"),
        ({"positions": np.full((8, 3), np.inf)}, "positions"),
        ({"positions": np.full((8, 3), 2**20 * H * 1.001)}, "positions: particle 0 at"),
    ],
)
def test_bad_input_is_refused_by_name(changes: dict[str, Any], named: str) -> None:
    good = {"values": np.zeros(8), "positions": lattice_block(2, D), "support_radius": H}
    pbf.operators.gradient(**good)
    with pytest.raises(errors.InvalidParameter, match=named):
        pbf.operators.gradient(**{**good, **changes})


@pytest.mark.parametrize("operator", [*FIELDS, "density"])
@pytest.mark.parametrize("h", [2.0**-19, 2.0**19])
def test_a_power_of_two_in_scale_changes_no_bit(operator: str, h: float) -> None:
    x = as_float32(jittered_block(4, 0.5, seed=59))
    power = {"density": 0, "laplacian": 2}.get(operator, 1)

    def at_scale(scale: float) -> NDArray[np.float64]:
        places = x * scale
        if operator == "density":
            return np.float64(pbf.operators.density(places, support_radius=scale))
        values = value_for(operator, x)
        result = getattr(pbf.operators, operator)(values, places, support_radius=scale)
        return result * scale**power

    np.testing.assert_array_equal(at_scale(h), at_scale(1.0))


@pytest.mark.parametrize("values", [["a"] * 8, np.zeros(8, complex), None])
def test_values_that_are_not_real_numbers_are_a_type_error(values: Any) -> None:
    with pytest.raises(errors.WrongType, match="values"):
        pbf.operators.gradient(values, lattice_block(2, D), support_radius=H)
