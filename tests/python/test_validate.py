"""The validation cases run, and what they find is within the marks where it is known to be."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest

pytest.importorskip("matplotlib")

from pbfluids.validate import CASES, __main__, load
from pbfluids.validate.case import Check
from pbfluids.validate.ellipse import semi_axes, solution

QUICK = tuple(name for name in CASES if name != "energy")


@pytest.fixture(scope="module")
def records(tmp_path_factory: pytest.TempPathFactory) -> dict[str, Any]:
    """What quick runs write, by case."""
    out = tmp_path_factory.mktemp("validation")
    assert __main__.main([*QUICK, "--quick", "--threads", "2", "--out", str(out)]) == 0
    for name in QUICK:
        assert (out / f"{name}.png").read_bytes().startswith(b"\x89PNG")
    return {name: json.loads((out / f"{name}.json").read_text("utf-8")) for name in QUICK}


def values(record: dict[str, Any], words: str) -> list[float]:
    found = [check["value"] for check in record["checks"] if words in check["name"]]
    assert found, [check["name"] for check in record["checks"]]
    return found


def test_a_record_says_what_was_run_and_whether_each_mark_was_reached(records) -> None:
    for name, record in records.items():
        assert (record["case"], record["quick"]) == (name, True)
        assert record["checks"]
        assert record["seconds"] > 0
        for check in record["checks"]:
            assert check["passed"] == (abs(check["value"]) <= check["mark"])


def test_the_front_of_the_dam_break_is_that_of_the_experiment(records) -> None:
    assert max(values(records["dam_break_front"], "gate shift")) < 5
    for fronts in records["dam_break_front"]["series"]["Z"].values():
        assert np.all(np.diff(fronts) > -0.05)
        assert fronts[-1] > 3.5


def test_the_tank_keeps_its_height_and_density_and_bears_its_weight(records) -> None:
    tank = records["hydrostatic_tank"]
    for words in ("height", "mean density", "first layer", "in the last second"):
        assert all(check["passed"] for check in tank["checks"] if words in check["name"]), tank[
            "checks"
        ]
    # Of twenty layers the lowest counts for more than of a hundred.
    assert values(tank, "1 − R²") == pytest.approx([0, 0], abs=0.02)
    assert values(tank, "bottom against") == pytest.approx([0, 0], abs=6)


def test_the_drops_follow_their_equations(records) -> None:
    assert values(records["elliptical_drop"], "semi-axis b") == pytest.approx([0], abs=2)
    assert values(records["oscillating_drop"], "period") == pytest.approx([0], abs=3)


def test_collisions_keep_momentum(records) -> None:
    assert max(values(records["collision"], ": momentum")) < 1e-6


def test_the_density_is_that_of_the_tolerance_for_any_time_step(records) -> None:
    assert np.ptp(values(records["independence"], "density")) < 0.1


def test_a_unit_circle_at_rest_stays_and_an_ellipse_keeps_its_area() -> None:
    t = np.linspace(0, 5, 500)
    np.testing.assert_array_equal(solution(0.0, 1.0, t), 1.0)
    axes = solution(0.5, 1.0, t)
    np.testing.assert_allclose(axes.prod(axis=1), 1.0, rtol=1e-6)
    k = np.argmin(np.abs(t - 4.567375))
    assert axes[k] == pytest.approx([1, 1], abs=0.005)  # a period later it is the circle again


def test_the_semi_axes_of_an_ellipse_full_of_points_are_its_own() -> None:
    x = np.random.default_rng(3).uniform(-1, 1, (200_000, 3))
    x = x[np.hypot(x[:, 0], x[:, 1]) < 1] * [2.0, 0.5, 0.0] + [5.0, -3.0, 0.0]
    assert semi_axes(x.astype(np.float32)) == pytest.approx([2.0, 0.5], rel=0.01)


@pytest.mark.parametrize(
    ("value", "passed"), [(1.0, True), (-1.0, True), (1.01, False), (np.nan, False)]
)
def test_a_check_is_passed_up_to_its_mark(value: float, passed: bool) -> None:
    assert Check("", value, 1.0).passed is passed


def test_every_case_says_what_it_compares_and_how() -> None:
    for name in CASES:
        case = load(name)
        assert case.__doc__
        assert len(case.DISCUSSION) > 200


def test_an_unknown_case_is_refused_with_those_that_there_are(capsys) -> None:
    with pytest.raises(SystemExit) as caught:
        __main__.main(["dam_brake"])
    assert caught.value.code == 2
    assert "no case is called dam_brake; known: dam_break_front," in capsys.readouterr().err


def test_the_page_is_not_written_from_a_quick_run_nor_from_none(tmp_path, capsys) -> None:
    docs = ["--out", str(tmp_path), "--write-docs", str(tmp_path / "docs")]
    assert __main__.main(docs) == 2
    assert "run `python -m pbfluids.validate dam_break_front` first" in capsys.readouterr().err
    (tmp_path / "dam_break_front.json").write_text('{"quick": true}', encoding="utf-8")
    assert __main__.main(docs) == 2
    assert "is of a quick run" in capsys.readouterr().err


def test_a_case_that_cannot_run_makes_the_exit_code_1(tmp_path, monkeypatch, capsys) -> None:
    def broken(settings: object) -> None:
        raise RuntimeError("no water")

    monkeypatch.setattr(load("collision"), "run", broken)
    assert __main__.main(["collision", "--out", str(tmp_path)]) == 1
    assert "collision could not run" in capsys.readouterr().err
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize("missing", ["matplotlib.figure", "rich"])
def test_a_missing_package_is_one_line_that_names_the_extra(outside, missing: str) -> None:
    done = outside(
        f"import sys; sys.modules['{missing}'] = None\n"
        "from pbfluids.validate.__main__ import main\n"
        "sys.exit(main([]))"
    )
    assert done.returncode == 1
    assert "pip install 'pbfluids[validate]'" in done.stderr
    assert len(done.stderr.splitlines()) == 1


def test_the_page_shows_marks_and_misses(tmp_path: Path, records, monkeypatch) -> None:
    from pbfluids.validate import report

    monkeypatch.setattr(report, "CASES", QUICK)
    for name, record in records.items():
        text = json.dumps({**record, "quick": False})
        (tmp_path / f"{name}.json").write_text(text, encoding="utf-8")
    page = report.write_page(tmp_path, tmp_path / "docs").read_text("utf-8")
    checks = [check for record in records.values() for check in record["checks"]]
    assert page.count("**miss**") == sum(not check["passed"] for check in checks)
    for name in QUICK:
        image = tmp_path / "docs" / "images" / "validation" / f"{name}.png"
        assert 1000 < image.stat().st_size < 100_000
        assert f"(images/validation/{name}.png)" in page
