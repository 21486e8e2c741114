"""The study of facade checks: its cells, its classes, its folder and its page."""

import csv
import json
import math
import re
from pathlib import Path

import matplotlib as mpl
import numpy as np
import pytest

from rocksteady import Execution, check_facade
from rocksteady.codes import FacadeDemand, RecordDemand, run_facade
from rocksteady.errors import InputError, ModelError, OutputError
from rocksteady.motions import make_synthetic_suite
from rocksteady.show.export.files import figure_bytes
from rocksteady.studies.facade_checks import study as module
from rocksteady.studies.facade_checks._checked_walls import METHODS, SHARE
from rocksteady.studies.facade_checks._pictures import worked_figure
from rocksteady.studies.facade_checks.study import facade_checks, parts_of, plane_of
from tests.every import every
from tests.outputs import unrendered
from tests.studies.facade_checks.smallest import HEIGHTS_M, PGA_G, SLENDERNESS, plane, study

mpl.use("Agg")
G = 9.80665


@pytest.fixture(scope="module")
def saved(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder into which the study was saved, its pictures unrendered; for reading only."""
    folder = tmp_path_factory.mktemp("study") / "out"
    with unrendered():
        study().save(folder)
    return folder


@pytest.mark.slow
@every(
    ("cell", "factor"),
    [((0, 0, 1), 1.0), ((0, 2, 2), 1.0), ((1, 0, 0), 1.0), ((1, 1, 1), 1.0), ((1, 2, 0), 1.35)],
)
def test_a_cell_is_what_the_checks_of_its_wall_say(
    cell: tuple[int, int, int], factor: float
) -> None:
    found, (level, row, column) = study(factor).walls, cell
    wall = plane(factor).wall(row, column)
    assert wall.height_m == HEIGHTS_M[row]
    assert wall.height_m / wall.thickness_m == pytest.approx(SLENDERNESS[column], rel=1e-14)
    suite = make_synthetic_suite(8)
    scaled = [record.scaled(PGA_G[level] * G / record.peak_acceleration_m_s2) for record in suite]
    demand = FacadeDemand(slv=RecordDemand(records=tuple(scaled)))
    runs = run_facade(wall, suite, pga_g=PGA_G[level])
    checks = [
        each for each in check_facade(wall, demand, runs=runs).checks if each.limit_state == "SLV"
    ]
    assert [each.method for each in checks] == list(METHODS)
    for each in checks:
        assert each.demand is not None
        ratio = found.ratios[each.method][cell]
        assert ratio == pytest.approx(each.demand / each.capacity, rel=1e-9)
        assert (ratio <= 1.0) == each.satisfied
    assert found.dynamics[0].beyond[cell] == len(runs.beyond)


@pytest.mark.slow
def test_a_class_is_the_three_verdicts() -> None:
    values, found = study().values(), study().walls
    bits = np.stack([found.classes & 4, found.classes & 2, found.classes & 1]) > 0
    for accepts, ratio in zip(bits, found.ratios.values(), strict=True):
        np.testing.assert_array_equal(accepts, ratio <= 1.0)
    for level, each in enumerate(values["levels"]):
        assert math.fsum(each["shares"].values()) == pytest.approx(1.0)
        alike = (bits[:, level] == bits[0, level]).all(axis=0)
        assert each["agree"] == alike.mean()
    assert 0.0 < values["levels"][0]["agree"] < 1.0, "the small study has both"


def test_static_checks_follow_from_size_and_slenderness() -> None:
    """By hand: a0 = g/s with the mass at its centre, d_SLV = .4 (2/3) h/s of a bare wall, FC 1."""
    found = study().walls
    slenderness, pga = np.array(SLENDERNESS), np.array(PGA_G)[:, np.newaxis, np.newaxis]
    linear = 0.5 * pga * slenderness + np.zeros((3, 1))
    np.testing.assert_allclose(found.linear, linear, rtol=1e-12)
    # At one height all walls have one period, and the demand goes with the PGA.
    np.testing.assert_allclose(
        found.static / (pga * slenderness), found.static[:1, :, :1] / (0.15 * 7.0) + 0.0 * linear
    )


def test_what_other_assumptions_change_is_counted_at_the_middle_level() -> None:
    values, found = study().values(), study().walls
    assert values["variants_pga_g"] == PGA_G[1]
    first, *others = values["variants"]
    assert (first["newly_accepted"], first["newly_refused"], first["median_mean"]) == (0, 0, 1.0)
    count = found.classes[1].size
    for each in others:
        changed = each["newly_accepted"] - each["newly_refused"]
        assert round((each["accepted"] - first["accepted"]) * count) == changed


def test_a_worked_wall_disagrees_as_its_kind_says() -> None:
    assert study().worked, "the small study has walls that disagree"
    for wall in study().worked:
        ratios = wall.ratios
        refuses = wall.kind == "static refuses"
        assert (ratios["nonlinear static"] > 1.0) == refuses
        assert (ratios["dynamic"] <= 1.0) == refuses
        share = wall.runs.share[wall.governing].max()
        history = wall.history
        if math.isinf(share):
            assert history.overturn_time_pt is not None
        else:
            assert history.peak == pytest.approx(share, rel=1e-9)


def test_the_limit_of_a_run_is_in_the_unit_of_its_curve() -> None:
    for wall in study().worked:
        run = worked_figure(wall).axes[2]
        (curve,) = (line for line in run.lines if len(np.ravel(line.get_xdata())) > 100)
        unit = math.degrees(wall.history.block.alpha)  # type: ignore[union-attr]
        drawn = np.asarray(curve.get_ydata(), dtype=float)
        if wall.history.overturn_time_pt is None:
            assert np.abs(drawn).max() == pytest.approx(wall.history.peak * unit, rel=1e-3)
        levels = {float(np.ravel(line.get_ydata())[0]) for line in run.lines if line.is_dashed()}
        assert any(level == pytest.approx(SHARE * unit) for level in levels)


@pytest.mark.slow
def test_no_result_depends_on_how_it_is_run(tmp_path: Path) -> None:
    parts = parts_of(plane(), tmp_path / "out", resume=False, force=False)
    again = facade_checks(plane(), run=Execution(executor="serial"), parts=parts)
    assert parts.swept
    np.testing.assert_array_equal(again.walls.spectral, study().walls.spectral)
    for one, other in zip(again.walls.dynamics, study().walls.dynamics, strict=True):
        np.testing.assert_array_equal(one.share, other.share)
    assert again.values() == study().values()
    kept = parts_of(plane(), tmp_path / "out", resume=True, force=False)
    assert facade_checks(plane(), parts=kept).values() == study().values()
    with pytest.raises(OutputError, match="confidence_factor"):
        parts_of(plane(1.35), tmp_path / "out", resume=True, force=False)
    with pytest.raises(ModelError, match="store"):
        facade_checks(plane(), run=Execution(store=tmp_path / "store"))


@pytest.mark.slow
def test_the_folder_has_the_files_that_the_json_names(saved: Path) -> None:
    names = {file.name for file in saved.iterdir()}
    text = (saved / "facade-checks.json").read_text(encoding="utf-8")
    assert "NaN" not in text
    assert "Infinity" not in text
    values = json.loads(text)
    assert values["schema"] == "rocksteady/facade-checks/2"
    own = {"facade-checks.json", "facade-checks.html"}
    assert {*values["figures"], *values["tables"]} == names - own
    assert all(re.fullmatch(module.OURS, name) for name in names)
    assert values["height_m"] == HEIGHTS_M
    assert len(values["worked"]) == len(study().worked)
    for name in study().pictures:
        assert len(figure_bytes(study().figure(name), "png")) > 10_000
    with pytest.raises(OutputError, match="it holds"):
        study().save(saved)


@pytest.mark.slow
def test_the_table_has_a_row_for_each_wall_and_level(saved: Path) -> None:
    with (saved / "walls.csv").open(encoding="utf-8", newline="") as stream:
        rows = list(csv.DictReader(stream))
    assert len(rows) == 2 * 9
    found = study().walls
    for row, ratio in zip(rows, found.dynamic.ravel().tolist(), strict=True):
        assert float(row["dynamic"]) == ratio
        assert (int(row["records_beyond_d0"]) > 0) == math.isinf(ratio)


@pytest.mark.slow
def test_the_page_has_its_parts(saved: Path) -> None:
    page = (saved / "facade-checks.html").read_text(encoding="utf-8")
    assert page.count("<img ") == len(study().pictures)
    for part in ("verdicts", "walls", "ratios", "variants", "methods"):
        assert f'<h2 id="{part}">' in page
    assert "not checked against the printed standard" in page
    assert "8 records" in page.replace("\n", " ")
    assert "--height-m 2,6,11 --slenderness 7:19:3" in page, "the command that makes it again"
    assert study().sentences[0].replace("\N{NO-BREAK SPACE}", " ").split(" (")[0] in page.replace(
        "\N{NO-BREAK SPACE}", " "
    )


@every(
    ("change", "words"),
    [
        ({"height_m": [3.0]}, "2 values or more"),
        ({"height_m": [3.0, 2.0]}, "ascend"),
        ({"height_m": [3.0, 200.0]}, "height_m = 200"),
        ({"slenderness": [1.0, 5.0]}, "slenderness = 1"),
        ({"pga_g": [0.2, 9.0]}, "pga_g = 9"),
        ({"pga_g": []}, "1 value or more"),
        ({"confidence_factor": 3.0}, "confidence_factor"),
        ({"records": make_synthetic_suite(6)}, "records"),
    ],
)
def test_what_is_out_of_range_is_refused(change: dict[str, object], words: str) -> None:
    with pytest.raises(InputError, match=words):
        plane_of(**change)  # type: ignore[arg-type]
