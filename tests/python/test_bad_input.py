"""Bad input is a typed error that names field, value and rule, and changes nothing."""

from __future__ import annotations

import numpy as np
import pytest
from support.limits import beyond

import pbfluids as pbf
from pbfluids.errors import FluidError, InvalidParameter, SimulationFailed, WrongType


@pytest.fixture
def sim():
    simulation = pbf.Simulation(
        pbf.FluidParams(spacing=0.05), domain=pbf.Box((0, 0, 0), (0.4, 0.4, 0.4))
    )
    simulation.add_particles(pbf.block((0, 0, 0), (0.2, 0.2, 0.2), spacing=0.05))
    simulation.step(0.005)
    return simulation


def rejects(sim, error, message, call):
    before = sim.state_hash(), len(sim), sim.time, sim.step_count
    with pytest.raises(error, match=message) as caught:
        call()
    assert isinstance(caught.value, FluidError)
    assert (sim.state_hash(), len(sim), sim.time, sim.step_count) == before


@pytest.mark.parametrize(
    ("positions", "error", "message"),
    [
        (np.zeros((3, 4)), InvalidParameter, r"positions: expected shape \(n, 3\).*got \(3, 4\)"),
        (np.zeros(3), InvalidParameter, r"positions: expected shape \(n, 3\).*got \(3,\)"),
        (np.zeros((1, 1, 3)), InvalidParameter, r"positions: expected shape.*got \(1, 1, 3\)"),
        ([[0.1, np.nan, 0.1]], InvalidParameter, "positions: .*not finite.*row 0"),
        ([[0.1] * 3, [np.inf] * 3], InvalidParameter, "positions: .*not finite.*row 1"),
        ([[1e300, 0.1, 0.1]], InvalidParameter, "positions: .*too large for float32"),
        ([["a", "b", "c"]], WrongType, "positions: expected an array of real numbers"),
        ([[1j, 0, 0]], WrongType, "positions: .*complex128"),
        ([[True, False, True]], WrongType, "positions: .*bool"),
        (None, WrongType, "positions: expected an array"),
        ([[0.1, 0.1, 0.41]], InvalidParameter, "positions"),
    ],
)
def test_positions_that_are_none_are_rejected(sim, positions, error, message):
    rejects(sim, error, message, lambda: sim.add_particles(positions))


def test_masked_numbers_are_no_data(sim):
    positions = np.ma.masked_array([[0.1] * 3, [0.3] * 3], mask=[[0] * 3, [1] * 3])
    masked = "3 of its numbers are masked"
    rejects(sim, InvalidParameter, f"positions: {masked}", lambda: sim.add_particles(positions))
    values = np.ma.masked_array([0.0, 1.0], mask=[False, True])
    faces = np.ma.masked_array([[0, 0, 0]], mask=True)
    light = np.ma.masked_less(np.zeros((2, 4, 3)), 1)
    with pbf.Renderer(16, 16, backend="cpu") as renderer:
        with pytest.raises(InvalidParameter, match="values: 1 of its numbers are masked"):
            renderer.render(positions.data, pbf.Camera(), values=values)
        with pytest.raises(InvalidParameter, match="environment_map: 24 of its numbers are masked"):
            renderer.set_environment_map(light)
    with pytest.raises(InvalidParameter, match=f"faces: {masked}"):
        pbf.Mesh([[0, 0, 0]], faces)
    sim.add_particles(np.ma.compress_rows(positions))  # the remedy
    sim.add_particles(np.ma.masked_array([[0.3] * 3], mask=False))


@pytest.mark.parametrize(
    ("kernel", "distance", "exponent"),
    [("wendland", 0.99, 4), ("poly6_spiky", 0.7, 4), ("cubic_spline", 1 - 1e-7, 16)],
)
def test_repulsion_that_would_blow_up_fluid_at_rest_is_rejected(kernel, distance, exponent):
    fluid = pbf.FluidParams(spacing=0.05, kernel=kernel)
    wrong = pbf.SolverParams(tensile_distance=distance, tensile_exponent=exponent)
    message = "tensile_distance = .* fluid at rest would repel itself .* a smaller distance"
    with pytest.raises(InvalidParameter, match=message):
        pbf.Simulation(fluid, wrong)
    right = pbf.Simulation(fluid, wrong.replace(tensile_strength=0))
    with pytest.raises(InvalidParameter, match=message):
        right.solver = wrong
    assert right.solver.tensile_strength == 0


@pytest.mark.parametrize(
    ("velocities", "message"),
    [
        (np.zeros((2, 3)), "velocities: 2 rows, but positions has 1"),
        (np.zeros((1, 2)), r"velocities: expected shape \(n, 3\)"),
        ([[0, np.nan, 0]], "velocities: .*not finite"),
    ],
)
def test_velocities_that_do_not_fit_are_rejected(sim, velocities, message):
    rejects(
        sim, InvalidParameter, message, lambda: sim.add_particles([[0.3, 0.3, 0.3]], velocities)
    )


def test_positions_that_the_grid_cannot_reach_are_rejected():
    # They would be stuck: every step would fail, and nothing takes a particle out.
    space = pbf.Simulation(pbf.FluidParams(spacing=0.05))
    space.add_particles([[0, 0, 0], [2**20 * 0.1, 0, 0]])
    rejects(
        space,
        InvalidParameter,
        r"positions: particle 1 at \(0, -104858.*, 0\) m; must be within 104858 m",
        lambda: space.add_particles([[0, 0, 0], [0, -(2**20) * 0.1000001, 0]]),
    )
    space.step(0.001)


@pytest.mark.parametrize("dt", [0.0, -0.01, 9e-16, 1e-45, np.nan, np.inf, -np.inf])
def test_a_time_step_that_is_not_positive_is_rejected(sim, dt):
    rejects(sim, InvalidParameter, "dt = .*must be", lambda: sim.step(dt))


@pytest.mark.parametrize("dt", [1e-15, 1e-12, 1e-9])
def test_the_shortest_time_steps_leave_numbers(sim, dt):
    sim.solver = sim.solver.replace(compliance=1e6)
    sim.step(dt)
    for array in (sim.positions, sim.velocities, sim.multipliers, sim.densities, sim.pressures):
        assert np.isfinite(array).all()


def test_a_step_that_fails_leaves_the_bits_of_those_that_follow(sim):
    for _ in range(30):
        sim.step(0.004)
    before = {name: getattr(sim, name) for name in ("densities", "pressures", "multipliers")}
    other = pbf.Simulation(sim.fluid, domain=sim.domain)
    other.add_particles(pbf.block((0, 0, 0), (0.2, 0.2, 0.2), spacing=0.05))
    other.step(0.005)
    for _ in range(30):
        other.step(0.004)
    # The particles are sorted by where they fly to before their velocities overflow.
    rejects(sim, SimulationFailed, "not finite", lambda: sim.step(1e20))
    for name, array in before.items():
        np.testing.assert_array_equal(getattr(sim, name), array, err_msg=name)
    for simulation in (sim, other):
        simulation.step(0.004)
    assert sim.state_hash() == other.state_hash()


def test_an_adaptive_frame_ends_where_its_steps_are_less_than_time_can_tell():
    step = 2.0**-30
    solver = pbf.SolverParams(time_step="adaptive", min_time_step=step, max_time_step=step)
    simulation = pbf.Simulation(solver=solver)
    simulation.step(2.0**30)
    assert simulation.time + step == simulation.time
    simulation.advance(32 * step)
    assert simulation.step_count == 1 + 32


@pytest.mark.parametrize("seconds", [0.0, -0.01, 9e-13, np.nan, np.inf])
def test_a_frame_that_is_not_positive_is_rejected(sim, seconds):
    rejects(sim, InvalidParameter, "seconds = .*must be", lambda: sim.advance(seconds))


@pytest.mark.parametrize("dt", ["0.1", None, [0.1]])
def test_a_time_step_that_is_no_number_is_rejected(sim, dt):
    before = sim.state_hash()
    with pytest.raises(TypeError):
        sim.step(dt)
    assert sim.state_hash() == before


PARAMETERS = [pbf.FluidParams, pbf.SolverParams, pbf.RenderParams, pbf.Camera, pbf.Box]


def limits():
    """Each number of each struct with a value just outside each of its limits."""
    for struct in PARAMETERS:
        for field in struct.describe():
            if field["kind"] not in ("float", "int", "vec3"):
                continue
            outside = [beyond(field, end) for end in ("least", "most")]
            if field["kind"] != "int":
                outside.append(np.nan)
            if field["finite"] and field["kind"] != "int":
                outside += [np.inf, -np.inf]
            for value in (value for value in outside if value is not None):
                given = (value,) * 3 if field["kind"] == "vec3" else value
                yield pytest.param(struct, field["name"], given, id=f"{field['name']}={value:g}")


@pytest.mark.parametrize(("struct", "name", "value"), list(limits()))
def test_a_parameter_outside_its_range_is_named(struct, name, value):
    with pytest.raises(InvalidParameter, match=rf"^{struct.__name__}\.{name} = .*: must be"):
        struct(**{name: value})


@pytest.mark.parametrize("struct", PARAMETERS)
def test_a_parameter_of_another_type_is_named(struct):
    for field in struct.describe():
        with pytest.raises(WrongType, match=rf"^{struct.__name__}\.{field['name']} = "):
            struct(**{field["name"]: object()})


@pytest.mark.parametrize("struct", PARAMETERS)
def test_an_unknown_parameter_comes_with_those_there_are(struct):
    with pytest.raises(WrongType, match='has no parameter "spacingg"; it has '):
        struct(spacingg=1)


def test_a_rejected_assignment_leaves_the_parameter_as_it_was():
    params = pbf.SolverParams()
    with pytest.raises(InvalidParameter, match="iterations = 0"):
        params.iterations = 0
    assert params == pbf.SolverParams()


def test_all_faults_of_a_struct_are_listed_at_once():
    with pytest.raises(InvalidParameter) as caught:
        pbf.SolverParams(iterations=0, relaxation=-1.0, num_threads=1000)
    assert [line.split(" =")[0] for line in str(caught.value).splitlines()] == [
        "SolverParams.iterations",
        "SolverParams.relaxation",
        "SolverParams.num_threads",
    ]


def test_a_thread_count_that_would_end_the_process_is_rejected():
    with pytest.raises(InvalidParameter, match="num_threads = 100000: must be"):
        pbf.SolverParams(num_threads=100_000)


def test_a_box_inside_out_is_rejected():
    with pytest.raises(InvalidParameter, match=r"Box\.upper = .*greater than lower"):
        pbf.Box((0, 0, 0), (1, -1, 1))


def test_a_domain_thinner_than_the_spacing_is_rejected():
    with pytest.raises(InvalidParameter):
        pbf.Simulation(pbf.FluidParams(spacing=0.1), domain=pbf.Box((0, 0, 0), (1, 1, 0.05)))


@pytest.mark.parametrize("spacing", [0.0, -1.0, np.nan])
def test_a_block_needs_a_positive_spacing(spacing):
    with pytest.raises(InvalidParameter, match="spacing"):
        pbf.block((0, 0, 0), (1, 1, 1), spacing=spacing)


def test_what_is_no_mesh_is_refused_by_its_place():
    mesh = pbf.Mesh(np.eye(3), [[0, 1, 2]])
    with pbf.Renderer(8, 8) as renderer:
        for thing in (None, 3, "boat.obj"):
            with pytest.raises(WrongType, match=rf"^meshes\[1\] = {thing!r}: must be a Mesh"):
                renderer.render(np.zeros((1, 3)), pbf.Camera(), meshes=[mesh, thing])


def test_a_block_of_more_particles_than_memory_holds_is_an_error_not_a_crash():
    with pytest.raises(FluidError):
        pbf.block((0, 0, 0), (1, 1, 1), spacing=1e-6)
