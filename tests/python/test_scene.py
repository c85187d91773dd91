"""Scenes: strict files, every fault at once, defaults from one place."""

from __future__ import annotations

import contextlib
import copy
import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from support.limits import beyond
from support.scenes import TINY, faults_of

import pbfluids as pbf
from pbfluids import toml
from pbfluids.errors import InvalidParameter, SceneError
from pbfluids.scene_model import DERIVED, STRUCTS, TABLES


def test_every_fault_is_listed_at_once_with_its_path(tiny):
    tiny["duration"] = "4"
    tiny["frame_rate"] = 0
    tiny["fluid"] = {"spacing": -1.0, "kernel": "gauss"}
    tiny["solver"] = {"iterations": 1.5, "num_threads": 100_000}
    tiny["domain"]["upper"] = [1.0, 1.0]
    tiny["blocks"] = [
        {"lower": [0, 0, 0], "uper": [1, 1, 1]},
        {"lower": [0, 0, 0], "upper": [1, -1, 1]},
        {"lower": [0, 0, math.nan], "upper": [1, "1", 1]},
    ]
    faults = faults_of(tiny)
    assert [fault.split(":")[0].split(" =")[0] for fault in faults] == [
        "duration",
        "frame_rate",
        "domain.upper",
        "blocks[0].upper",
        "blocks[0].uper",
        "blocks[2].lower[2]",
        "blocks[2].upper[1]",
        "fluid.kernel",
        "solver.iterations",
        "fluid.spacing",
        "solver.num_threads",
        "blocks[1].upper[1]",
    ]


@pytest.mark.parametrize(
    ("table", "key", "fault"),
    [
        (("blocks", 0), "uper", 'blocks[0].uper: unknown, did you mean "upper"?'),
        (("fluid",), "spacng", 'fluid.spacng: unknown, did you mean "spacing"?'),
        ((), "durration", 'durration: unknown, did you mean "duration"?'),
        ((), "iterations", 'iterations: unknown, did you mean "iterations" in [solver]?'),
        (("domain",), "zzz", "domain.zzz: unknown, known here are lower, upper, periodic"),
    ],
)
def test_an_unknown_key_comes_with_the_name_that_was_meant(tiny, table, key, fault):
    inner = tiny
    for step in table:
        inner = inner[step]
    inner[key] = 1.0
    assert faults_of(tiny) == [fault]


@pytest.mark.parametrize(
    ("changes", "fault"),
    [
        ({"schema": 2}, "schema = 2: must be 1"),
        ({"name": "../x"}, 'name = "../x": must be letters, digits, _ and - only'),
        ({"duration": -1}, "duration = -1: must be > 0"),
        ({"duration": math.inf}, "duration = Infinity: must be finite"),
        ({"frame_rate": True}, "frame_rate = true: must be a number"),
        ({"frame_rate": 1e-4}, "frame_rate = 0.0001: must be >= 0.001"),
        ({"frame_rate": 2e6}, "frame_rate = 2000000.0: must be <= 1e+06"),
        (
            {"blocks": [{"lower": [0, 0, 0], "upper": [0.2] * 3, "velocity": [0, 1e39, 0]}]},
            "blocks[0].velocity[1] = 1e+39: must be <= 1e+30",
        ),
        ({"fluid": 3}, "fluid = 3: must be a table"),
        (
            {"fluid": {"kernel": "gauss"}},
            "fluid.kernel = \"gauss\": must be 'poly6_spiky', 'cubic_spline' or",
        ),
        ({"fluid": {"gravity": [0, 1]}}, "fluid.gravity = [0, 1]: must have 3 values"),
        ({"solver": {"substeps": 10**30}}, "solver.substeps = 1000000000"),
        ({"solver": {"substeps": 0}}, "solver.substeps = 0: must be finite, >= 1"),
        ({"blocks": []}, "blocks: missing"),
        ({"blocks": 1}, "blocks = 1: must be a list"),
        ({"domain": {"lower": [0, 0, 0], "upper": [0, 1, 1]}}, "domain.upper = (0, 1, 1) m: must"),
        (
            {"fluid": {"spacing": 0.05, "support_radius": 0.3}},
            "fluid.support_radius = 0.3 m: must be finite, >= 0.06 and <= 0.2",
        ),
    ],
)
def test_a_value_that_breaks_a_rule_is_named_with_the_rule(tiny, changes, fault):
    (found,) = faults_of({**tiny, **changes})
    assert found.startswith(fault)


@pytest.mark.parametrize("key", ["schema", "name", "duration", "frame_rate"])
def test_a_missing_key_is_named(tiny, key):
    del tiny[key]
    assert faults_of(tiny) == [f"{key}: missing"]


def test_fluid_outside_the_domain_is_a_fault(tiny):
    tiny["blocks"][0]["upper"] = [0.2, 0.5, 0.2]
    assert faults_of(tiny) == ["blocks[0]: outside the domain, y = 0.5 m > 0.4 m"]


def test_fluid_in_the_same_place_twice_is_a_fault(tiny):
    tiny["blocks"].append({"lower": [0.15, 0.0, 0.0], "upper": [0.3, 0.2, 0.2]})
    tiny["balls"] = [{"center": [0.05, 0.22, 0.1], "radius": 0.05}]
    assert faults_of(tiny) == [
        "blocks[1]: overlaps blocks[0] by 0.05 m; fluid cannot be there twice",
        "balls[0]: overlaps blocks[0] by 0.03 m; fluid cannot be there twice",
    ]


def test_blocks_that_touch_are_fine(tiny):
    tiny["blocks"].append({"lower": [0.2, 0.0, 0.0], "upper": [0.4, 0.2, 0.2]})
    assert len(pbf.Scene(tiny).particles()[0]) == 128


def test_a_ball_beside_the_corner_of_a_block_does_not_overlap_it(tiny):
    reach = 0.1 / math.sqrt(2) + 0.001  # the boxes around them overlap, they do not
    tiny["balls"] = [{"center": [0.2 + reach, 0.2 + reach, 0.1], "radius": 0.1}]
    assert len(pbf.Scene(tiny).particles()[0]) > 64


def test_a_block_thinner_than_the_spacing_is_a_fault(tiny):
    tiny["blocks"][0]["upper"] = [0.2, 0.04, 0.2]
    (fault,) = faults_of(tiny)
    assert fault.startswith("blocks[0]: 0.04 m along y is less than fluid.spacing = 0.05 m")


def test_more_particles_than_memory_holds_are_a_fault_before_any_is_made(tiny):
    tiny["fluid"]["spacing"] = 2e-6
    (fault,) = faults_of(tiny)
    assert fault.startswith("fluid.spacing = 2e-06 m: makes about 1e+15 particles")


def test_the_message_begins_with_the_file(tmp_path):
    path = tmp_path / "bad.toml"
    path.write_text("schema = 1\n", encoding="utf-8")
    with pytest.raises(SceneError, match=rf"^{path}: 4 faults\n  name: missing"):
        pbf.Scene.load(path)


def test_broken_toml_is_reported_with_file_and_line(tmp_path):
    path = tmp_path / "bad.toml"
    path.write_text('schema = 1\nname = "x\n', encoding="utf-8")
    with pytest.raises(SceneError, match=rf"^{path}: not TOML: .*line 2"):
        pbf.Scene.load(path)


def test_a_file_that_is_not_there_is_reported(tmp_path):
    with pytest.raises(SceneError, match=r"nowhere\.toml: cannot be read: No such file"):
        pbf.Scene.load(tmp_path / "nowhere.toml")


@pytest.mark.parametrize("value", ["[" * 2000 + "]" * 2000, "9" * 5000])
def test_more_than_the_parser_takes_is_a_fault(tmp_path, value):
    path = tmp_path / "scene.toml"
    path.write_text(f"schema = {value}\n")
    with pytest.raises(SceneError, match=r"scene\.toml: not TOML: "):
        pbf.Scene.load(path)


@pytest.mark.parametrize("depth", [40, 600, 20_000])
def test_what_is_nested_too_deeply_is_a_fault(tmp_path, tiny, depth):
    lists, tables, dotted = 1, 1, ".".join(["a"] * depth)
    for _ in range(depth):
        lists, tables = [lists], {"a": tables}
    endless = []
    endless.append(endless)
    for value in (lists, tables, endless):
        with pytest.raises(SceneError, match=r"^scene: tables or lists are nested more than 32"):
            pbf.Scene({**tiny, "name": value})
        with pytest.raises(SceneError, match="nested more than 32"):
            pbf.Scene(tiny).replace(name=value)
    with pytest.raises(SceneError, match="nested more than 32"):
        pbf.Scene(tiny).replace(**{dotted: 1})
    path = tmp_path / "deep.toml"
    path.write_text(f"{dotted} = 1\n")
    with pytest.raises(SceneError, match=rf"^{path}: tables or lists are nested more than 32"):
        pbf.Scene.load(path)


def test_an_unknown_builtin_comes_with_the_name_that_was_meant():
    with pytest.raises(SceneError, match='did you mean "dam_break"'):
        pbf.Scene.builtin("dam_brake")


def test_the_builtin_scenes_are_the_four():
    assert pbf.Scene.names() == ["dam_break", "double_dam_break", "drop_into_pool", "resting_tank"]


@pytest.mark.parametrize("name", pbf.Scene.names())
def test_a_builtin_scene_starts_inside_its_domain_at_rest_density(name):
    scene = pbf.Scene.builtin(name)
    positions, velocities = scene.particles()
    assert positions.dtype == velocities.dtype == np.float32
    assert positions.shape == velocities.shape
    lower, upper = np.array(scene.domain.lower), np.array(scene.domain.upper)
    half = scene.fluid.spacing / 2
    assert np.all(positions > lower + 0.99 * half)
    assert np.all(positions < upper - 0.99 * half)
    densities = scene.simulation().densities
    assert np.median(densities) == pytest.approx(scene.fluid.rest_density, rel=2e-3)
    assert scene.name == name
    assert scene.description


def test_the_dam_break_has_at_least_30_000_particles_and_4_seconds():
    scene = pbf.Scene.builtin("dam_break")
    assert len(scene.particles()[0]) >= 30_000
    assert scene.duration >= 4.0


@pytest.mark.parametrize("name", pbf.Scene.names())
def test_a_scene_written_and_read_again_is_the_same(name, tmp_path):
    scene = pbf.Scene.builtin(name)
    path = tmp_path / "again.toml"
    path.write_text(scene.to_toml(), encoding="utf-8")
    again = pbf.Scene.load(path)
    assert again == scene
    assert again.fluid == scene.fluid
    assert again.render_params == scene.render_params


def test_infinity_survives_toml_and_json(tiny):
    tiny["solver"]["constraint_floor"] = -math.inf
    scene = pbf.Scene(tiny)
    assert pbf.Scene(toml.loads(scene.to_toml())) == scene
    tiny["solver"]["constraint_floor"] = "-inf"  # as run.json has it
    assert pbf.Scene(tiny) == scene
    assert scene.solver.constraint_floor == -math.inf


@pytest.mark.parametrize(
    "overrides",
    [
        {"spacing": 0.1},
        {"fluid": {"spacing": 0.1}},
        {"fluid.spacing": 0.1},
        {"spacing": np.float64(0.1)},
    ],
)
def test_overrides_may_be_named_in_three_ways(overrides):
    scene = pbf.Scene.builtin("dam_break", **overrides)
    assert scene.fluid.spacing == pytest.approx(0.1)
    assert scene.domain == pbf.Scene.builtin("dam_break").domain


def test_overrides_are_checked_like_the_file():
    with pytest.raises(SceneError, match=r"fluid\.spacing = -1 m: must be"):
        pbf.Scene.builtin("dam_break", spacing=-1.0)
    with pytest.raises(SceneError, match='spacin: unknown, did you mean "spacing" in \\[fluid\\]'):
        pbf.Scene.builtin("dam_break", spacin=0.1)


def test_replace_leaves_the_scene_as_it_was(tiny):
    scene = pbf.Scene(tiny)
    longer = scene.replace(duration=1.0, gravity=(0.0, 0.0, 0.0))
    assert (scene.duration, longer.duration) == (0.1, 1.0)
    assert scene.fluid.gravity[1] == pytest.approx(-9.81)
    assert longer.fluid.gravity == (0.0, 0.0, 0.0)
    assert longer != scene


def test_what_is_not_given_has_the_structs_own_default(tiny):
    del tiny["fluid"], tiny["solver"]
    tiny["blocks"][0]["upper"] = [0.2, 0.2, 0.2]
    scene = pbf.Scene(tiny)
    assert scene.fluid == pbf.FluidParams()
    assert scene.solver == pbf.SolverParams()


def test_the_schema_says_what_the_structs_say():
    schema = pbf.Scene.json_schema()
    assert schema["required"] == ["schema", "name", "duration", "frame_rate"]
    for section, struct in STRUCTS.items():
        table = schema["$defs"][section.capitalize()]
        assert table["additionalProperties"] is False
        besides = {"render": ["color_by", "environment_map"]}.get(section, [])
        names = [field["name"] for field in struct.describe()]
        assert list(table["properties"]) == names + besides
        for field in struct.describe():
            entry = table["properties"][field["name"]]
            assert entry["description"].startswith(field["doc"])
            assert entry.get("unit", "") == field["unit"]
            if field["name"] not in DERIVED.get(section, {}):
                default = field["default"]
                expected = list(default) if isinstance(default, tuple) else default
                assert entry["default"] == expected
            limits = entry["items"] if field["kind"] in ("vec2", "vec3") else entry
            bound = "exclusiveMinimum" if field["least_excluded"] else "minimum"
            assert limits.get(bound, -math.inf) == field["least"]


@pytest.mark.parametrize("section", STRUCTS)
def test_every_limit_in_the_schema_is_one_that_a_scene_keeps(section, tiny):
    limited = [
        field
        for field in STRUCTS[section].describe()
        if field["kind"] in ("float", "int") and math.isfinite(field["least"])
    ]
    assert limited
    for field in limited:
        table = {**tiny.get(section, {}), field["name"]: beyond(field, "least")}
        (fault,) = faults_of({**tiny, section: table})
        assert fault.startswith(f"{section}.{field['name']} = ")


def test_a_scene_without_camera_is_seen_whole(tiny):
    scene = pbf.Scene(tiny)
    camera = scene.camera
    assert camera.target == pytest.approx((0.2, 0.2, 0.1))
    reach = np.linalg.norm([0.4, 0.4, 0.2]) / 2
    distance = np.linalg.norm(np.subtract(camera.eye, camera.target))
    assert math.degrees(2 * math.asin(reach / distance)) == pytest.approx(camera.fov_y)


def test_sizes_of_the_picture_follow_from_spacing_and_domain(tiny):
    params = pbf.Scene(tiny).render_params
    assert params.particle_volume == pytest.approx(0.05**3)
    assert params.tank_upper == pytest.approx((0.4, 0.4, 0.2))
    tiny["render"] = {"particle_volume": 1e-3}
    assert pbf.Scene(tiny).render_params.particle_volume == pytest.approx(1e-3)


def test_open_space_has_no_domain_and_no_tank(tiny):
    del tiny["domain"]
    scene = pbf.Scene(tiny)
    assert scene.domain is None
    assert scene.render_params.tank_lower is None
    assert len(list(scene.frames())) == 3


def test_frame_0_is_the_initial_state_and_the_last_one_reaches_the_duration(tiny):
    scene = pbf.Scene(tiny)
    positions, _ = scene.particles()
    frames = list(scene.frames())
    assert [frame.index for frame in frames] == [0, 1, 2]
    assert scene.frame_count == 3
    np.testing.assert_array_equal(frames[0].positions, positions)
    assert frames[0].report is None
    assert frames[-1].time == pytest.approx(scene.duration, rel=1e-6)
    assert frames[-1].report.iterations == 2
    np.testing.assert_array_equal(frames[-1].ids, np.arange(64))


def test_a_duration_between_two_frames_ends_with_the_frame_after_it(tiny):
    tiny["duration"] = 0.12
    assert pbf.Scene(tiny).frame_count == 4


def test_frames_keep_their_arrays_while_the_simulation_goes_on(tiny):
    first, *_, last = pbf.Scene(tiny).frames()
    assert first.positions.mean() > last.positions.mean()
    assert first.state_hash != last.state_hash


def test_two_runs_of_a_scene_have_the_same_bits(tiny):
    one = [frame.state_hash for frame in pbf.Scene(tiny).frames()]
    two = [frame.state_hash for frame in pbf.Scene(tiny).replace(num_threads=3).frames()]
    assert one == two


def test_progress_hears_of_each_frame(tiny):
    heard = []
    for _ in pbf.Scene(tiny).frames(progress=lambda done, total: heard.append((done, total))):
        pass
    assert heard == [(1, 3), (2, 3), (3, 3)]


def test_a_count_of_no_frames_is_rejected_at_once(tiny):
    with pytest.raises(InvalidParameter, match="count = 0"):
        pbf.Scene(tiny).frames(0)


def test_blocks_and_balls_start_with_their_velocities(tiny):
    tiny["blocks"][0]["velocity"] = [1.0, 2.0, 3.0]
    tiny["balls"] = [{"center": [0.3, 0.3, 0.1], "radius": 0.08, "velocity": [0, -1, 0]}]
    positions, velocities = pbf.Scene(tiny).particles()
    np.testing.assert_array_equal(velocities[:64], np.tile(np.float32([1, 2, 3]), (64, 1)))
    np.testing.assert_array_equal(velocities[64:, 1], -1)
    assert np.all(np.linalg.norm(positions[64:] - [0.3, 0.3, 0.1], axis=1) <= 0.08 + 1e-6)


def test_every_table_of_the_file_is_closed_to_unknown_keys():
    assert all(table.model_config["extra"] == "forbid" for table in TABLES.values())


def test_any_text_survives_toml(tiny):
    tiny["description"] = 'quotes " and \\ and é\t\x7f\x01\U0001f30a'
    scene = pbf.Scene(tiny)
    assert pbf.Scene(toml.loads(scene.to_toml())).description == tiny["description"]


def test_files_are_found_beside_the_scene_file_and_kept_by_absolute_names(
    tiny, tmp_path, monkeypatch
):
    (tmp_path / "shapes").mkdir()
    for name in ("shapes/a.stl", "sky.hdr"):
        (tmp_path / name).touch()
    scene_file = tmp_path / "shapes" / "tiny.toml"
    tiny["meshes"] = [{"file": "a.stl"}]
    tiny["render"] = {"environment_map": "../sky.hdr"}
    scene_file.write_text(toml.dumps(tiny), encoding="utf-8")
    scene = pbf.Scene.load(scene_file)
    data = scene.as_dict()
    assert data["meshes"][0]["file"] == str(tmp_path / "shapes/a.stl")
    assert data["render"]["environment_map"] == str(tmp_path / "sky.hdr")
    assert pbf.Scene(toml.loads(scene.to_toml())) == scene
    # What is no part of the file is relative to the working directory.
    monkeypatch.chdir(tmp_path)
    tiny["meshes"][0]["file"] = "shapes/a.stl"
    tiny["render"]["environment_map"] = tmp_path / "sky.hdr"
    assert pbf.Scene(tiny) == scene
    assert pbf.Scene.load(scene_file, environment_map="sky.hdr") == scene


def test_files_that_are_not_there_are_faults_beside_the_others(tiny, tmp_path):
    tiny["duration"] = -1
    tiny["meshes"] = [{"file": str(tmp_path / "no.obj")}, {"file": str(tmp_path), "scale": 0}]
    tiny["render"] = {"environment_map": "/no\0where.hdr", "radius": -1}
    assert [fault.split(" =")[0] for fault in faults_of(tiny)] == [
        "duration",
        "meshes[1].scale",
        "render.radius",
        "meshes[0].file",
        "meshes[1].file",
        "render.environment_map",
    ]
    assert f'"{tmp_path}/no.obj": there is no such file' in faults_of(tiny)[3]


@pytest.mark.parametrize(
    ("mesh", "fault"),
    [
        ({}, "meshes[0].file: missing"),
        ({"file": 3}, "meshes[0].file = 3: must be a string"),
        ({"file": __file__, "colr": 1}, 'meshes[0].colr: unknown, did you mean "color"?'),
        ({"file": __file__, "color": [0, 0, 2]}, "meshes[0].color[2] = 2: must be <= 1"),
        ({"file": __file__, "color": [-1, 0, 0]}, "meshes[0].color[0] = -1: must be >= 0"),
        ({"file": __file__, "rotation": [0, 0]}, "meshes[0].rotation = [0, 0]: must have 3 values"),
    ],
)
def test_a_mesh_that_breaks_a_rule_is_named_with_the_rule(tiny, mesh, fault):
    assert faults_of({**tiny, "meshes": [mesh]}) == [fault]


def test_a_map_of_light_is_shown_and_mirrored_unless_the_scene_says_otherwise(tiny):
    assert pbf.Scene(tiny).render_params.background == "sky"
    lit = pbf.Scene(tiny).replace(environment_map=__file__)
    assert (lit.render_params.background, lit.render_params.reflection) == ("map", "map")
    plain = lit.replace(background="plain").render_params
    assert (plain.background, plain.reflection) == ("plain", "map")


PATHS = [
    *(("fluid",), ("solver",), ("domain",), ("blocks",), ("balls",), ("camera",), ("render",)),
    *(("fluid", "spacing"), ("fluid", "gravity"), ("solver", "iterations"), ("domain", "upper")),
    *(("blocks", 0), ("blocks", 0, "lower"), ("blocks", 0, "upper", 1), ("name",), ("duration",)),
    *(("schema",), ("frame_rate",), ("camera", "eye"), ("render", "radius")),
    *(("meshes",), ("meshes", 0), ("meshes", 0, "file"), ("render", "environment_map")),
]
VALUES = st.recursive(
    st.none() | st.booleans() | st.integers() | st.floats() | st.text(max_size=5),
    lambda inner: (
        st.lists(inner, max_size=4) | st.dictionaries(st.sampled_from(["lower", "x"]), inner)
    ),
    max_leaves=6,
)


@settings(max_examples=150, deadline=None)
@given(st.lists(st.tuples(st.sampled_from(PATHS), VALUES), min_size=1, max_size=3))
def test_whatever_a_file_holds_it_is_a_scene_or_a_scene_error(changes):
    data = copy.deepcopy({**TINY, "balls": [], "camera": {}, "render": {}})
    data["meshes"] = [{"file": __file__}]
    for path, value in changes:
        table = data
        for step in path[:-1]:
            try:
                table = table[step]
            except (KeyError, IndexError, TypeError):
                break
        if isinstance(table, dict):
            table[path[-1]] = value
        elif isinstance(table, list) and len(table) > 1:
            table[1] = value
    with contextlib.suppress(SceneError):
        assert pbf.Scene(data).frame_count >= 1


def test_a_scene_colored_by_speed_has_a_range_that_no_particle_leaves(tiny):
    tiny["render"] = {"color_by": "speed"}
    scene = pbf.Scene(tiny)
    low, high = scene.render_params.color_range
    assert low == 0
    assert high == pytest.approx(np.sqrt(2 * 9.81 * 0.175), rel=1e-5)  # the top layer's center
    assert scene.render_params.legend == "speed [m/s]"
    for frame in scene.frames():
        speed = scene.values(frame)
        assert np.allclose(speed, np.sqrt((frame.velocities**2).sum(axis=1)))
        assert speed.max() <= high
    assert pbf.Scene(scene.as_dict()) == scene


@pytest.mark.parametrize(
    ("color_by", "range_in_force", "colormap"),
    [
        ("pressure", (0, 1000 * 9.81 * 0.175), "viridis"),
        ("density", (970, 1030), "viridis"),
        ("id", None, "shuffled"),
        (None, None, "viridis"),
    ],
)
def test_other_attributes_have_their_ranges_too(tiny, color_by, range_in_force, colormap):
    scene = pbf.Scene(tiny).replace(color_by=color_by) if color_by else pbf.Scene(tiny)
    params = scene.render_params
    assert params.color_range == (range_in_force and pytest.approx(range_in_force, rel=1e-5))
    assert params.colormap == colormap
    last = list(scene.frames())[-1]
    expected = {
        "pressure": last.pressures,
        "density": last.densities,
        "id": last.ids,
        None: None,
    }[color_by]
    assert np.array_equal(scene.values(last), expected)
    assert (last.densities is None) == (color_by != "density")
    assert (last.pressures is None) == (color_by != "pressure")


def test_what_the_scene_says_of_colors_comes_first(tiny):
    tiny["render"] = {"color_by": "speed", "color_range": [1.0, 2.0], "legend": ""}
    params = pbf.Scene(tiny).render_params
    assert (params.color_range, params.legend) == ((1, 2), "")


def test_nothing_at_rest_without_gravity_still_has_a_range(tiny):
    tiny["fluid"]["gravity"] = [0.0, 0.0, 0.0]
    tiny["render"] = {"color_by": "speed"}
    assert pbf.Scene(tiny).render_params.color_range == (0, 1)


def test_an_unknown_attribute_is_refused_with_the_known_ones(tiny):
    tiny["render"] = {"color_by": "sped"}
    assert faults_of(tiny) == [
        "render.color_by = \"sped\": must be 'speed', 'density', 'pressure' or 'id'"
    ]
