"""What every result has: rows of a data frame, whose columns are numeric, and its model."""

import contextlib
from collections.abc import Callable
from dataclasses import replace
from typing import Any

import matplotlib.pyplot as plt
import numpy as np
import pytest
import xarray as xr
from matplotlib.axes import Axes

import rocksteady as rs
from rocksteady.results import result as results
from rocksteady.results.gridded import described, describers, kind_of
from rocksteady.results.result import Result
from tests.public.things import things

NUMBERS: dict[str, tuple[Callable[[Any], Any], str]] = {
    "basins": (lambda found: found.label.ravel(), "label"),
    "boundaries": (lambda found: [found.kind.item()], "kind"),
    "cascade": (lambda found: found.values, "amplitude"),
    "course": (lambda found: found.velocity_m_s, "velocity_m_s"),
    "curve": (lambda found: found.peak, "peak"),
    "erosion": (lambda found: found.integrity_factor, "integrity_factor"),
    "fragility_curve": (lambda found: [row[2] / row[1] for row in found.stripes], "share"),
    "neighbours": (lambda found: [each.peak for each in found.cases], "peak"),
    "orbit": (lambda found: [state.speed for state in found.states], "speed_per_pivot_time"),
    "pushed": (lambda found: [found.friction_needed], "friction_needed"),
    "regions": (lambda found: found.heteroclinic, "heteroclinic"),
    "response": (lambda found: found.pseudo_velocity_m_s, "pseudo_velocity_m_s"),
    "quick": (lambda found: [found.median_pgv_m_s], "median_pgv_m_s"),
    "screens": (lambda found: [row.verdict for row in found.rows], "verdict"),
    "set": (lambda found: [found.horizontal[0].record.dt_s], "dt_s"),
    "steady": (lambda found: found.angle, "angle"),
    "two_stages": (lambda found: [row[3] for row in found.stripes], "probability"),
    "trail": (lambda found: [each.peaks[1] for each in found.attractors], "lowest"),
    "vector_fit": (lambda found: [found.aic], "aic"),
    "windows": (lambda found: found.low[np.isfinite(found.low)], "low"),
}
"""By name of a thing: what one of its columns holds."""


@pytest.fixture(scope="module", name="made")
def _made(tmp_path_factory: pytest.TempPathFactory) -> dict[str, Any]:
    """One of every class, made anew: what is kept has its files in a folder of other tests."""
    with contextlib.chdir(tmp_path_factory.mktemp("things")):
        made: dict[str, Any] = things.__wrapped__()
    return made


@pytest.mark.parametrize("name", NUMBERS)
def test_a_column_has_the_numbers_of_the_result(name: str, made: dict[str, Any]) -> None:
    numbers, column = NUMBERS[name]
    result = made[name]
    assert result.to_dataframe()[column].tolist() == pytest.approx(list(numbers(result)))


def test_every_result_has_rows_and_no_column_mixes_numbers_with_other_things(
    made: dict[str, Any],
) -> None:
    results = {name: each for name, each in made.items() if isinstance(each, Result)}
    assert set(NUMBERS) < set(results)
    for name, result in results.items():
        frame = result.to_dataframe()
        assert len(frame) > 0, name
        assert frame.columns.is_unique, name
        assert [str(column) for column in frame] == list(frame), name
        for column in (column for column in frame if frame[column].dtype.kind == "O"):
            kinds = {type(value) for value in frame[column].dropna()}
            assert kinds <= {str} or kinds == {bool}, (name, column, kinds)


def test_a_table_of_any_result_that_is_cut_keeps_its_worst_rows(made: dict[str, Any]) -> None:
    ranked, counted = set(), set()
    for name, result in made.items():
        content = described(result) if isinstance(result, xr.Dataset) else None
        if isinstance(result, Result):
            content = result.describe()
        for whole in content.tables if content else ():
            if len(whole.rows) < 2:
                continue
            table = replace(whole, most=len(whole.rows) // 2, alarm="")
            left = len(whole.rows) - table.most
            assert f"{left:,} more row" in table.remark, name
            if table.severity is None:
                assert table.shown == list(table.rows[: table.most]), name
            else:
                ranked.add(name)
                expected = sorted(map(table.severity, table.rows), reverse=True)[: table.most]
                assert list(map(table.severity, table.shown)) == expected, name
            if table.kind is not None:
                counted.add(name)
                kinds = table.remark.partition(": ")[2].split(", ")
                assert sum(int(each.split()[0].replace(",", "")) for each in kinds) == left, name
    assert {"facade runs", "spectrum", "windows"} <= ranked, ranked
    assert {"facade runs", "spectrum"} <= counted, counted


def test_a_result_without_a_table_is_one_row_of_its_plain_facts(made: dict[str, Any]) -> None:
    record = made["record"]
    found = rs.measure_intensity(record)
    values = {key: [value] for key, value in found.to_dict().items()}
    assert found.to_dataframe().to_dict("list") == values
    assert values["pga_m_s2"] == [pytest.approx(np.abs(record.acceleration_m_s2).max())]


def test_no_rows_keep_their_columns(made: dict[str, Any]) -> None:
    frame = rs.find_overturning_windows(
        made["bare"], "half-sine", [8.0], within=(0.1, 0.2)
    ).to_dataframe()
    assert len(frame) == 0
    assert {"frequency_ratio", "low", "high"} <= set(frame)


def test_a_gridded_result_is_a_row_a_cell(made: dict[str, Any]) -> None:
    found = made["map"]
    frame = found.rocksteady.to_dataframe()
    assert len(frame) == found.kind.size
    assert frame.set_index(["amplitude", "frequency_ratio"]).highest.loc[
        (2.0, 3.0)
    ] == pytest.approx(found.highest.sel(amplitude=2.0, frequency_ratio=3.0).item())


def test_a_result_whose_json_names_the_model_has_it(made: dict[str, Any]) -> None:
    results: dict[str, Any] = {n: each for n, each in made.items() if isinstance(each, Result)}
    named = {name: each.to_dict().get("model") for name, each in results.items()}
    models = {name: results[name].model.name for name, model in named.items() if model}
    assert models == {name: model for name, model in named.items() if model}
    assert {"boundaries", "branch", "cascade", "curve", "diagram", "neighbours"} <= set(models)


def test_all_neighbours_are_listed(made: dict[str, Any]) -> None:
    text = made["neighbours"].summary()
    assert "more rows" not in text
    assert text.count("at-rest") + text.count("overturned") == 26 + 1


@pytest.fixture(scope="module", name="drawable")
def _drawable(made: dict[str, Any]) -> dict[str, Any]:
    """One result of each kind of which there is a picture."""
    drawable: dict[str, Any] = {
        type(each).__name__: each for each in made.values() if isinstance(each, Result)
    }
    grids = [each for each in made.values() if isinstance(each, xr.Dataset)]
    drawable |= {kind_of(each): each for each in grids if kind_of(each)}
    drawable["rocking spectrum"] = made["spectrum"]  # of one record, as a picture is
    block, motion = (
        rs.DimensionlessBlock(restitution=0.87),
        rs.Harmonic(amplitude=3.0, frequency_ratio=4.2),
    )
    drawable["fate map"] = rs.map_fates(
        block, motion, axes={"phase": [0.0, 3.0], "velocity": [0.0, 0.5]}, cycles=5
    )
    search = rs.CurveSearch(orders=(3,), lines=(1, 1), max_impacts=2, max_period=3)
    curves = rs.find_bifurcation_curves(
        block, motion, within=((4.4, 5.4), (2.5, 4.0)), search=search
    )
    drawable["BifurcationCurve"] = curves.curves[0]
    return drawable


@pytest.mark.parametrize("kind", sorted(results._plots))
def test_every_result_of_which_there_is_a_picture_draws_it_without_an_argument(
    kind: str, drawable: dict[str, Any]
) -> None:
    thing = drawable[kind]
    axes = thing.rocksteady.plot() if kind in describers else thing.plot()
    try:
        assert isinstance(axes, Axes)
        assert axes.has_data()
        assert axes.get_xlabel()
        axes.figure.canvas.draw()
    finally:
        plt.close("all")


def test_one_response_curve_is_drawn_as_a_list_of_one_is(made: dict[str, Any]) -> None:
    drawn = [rs.plot_response(each) for each in (made["curve"], [made["curve"]])]
    try:
        one, other = ([np.asarray(line.get_ydata()) for line in axes.lines] for axes in drawn)
        assert len(one) == len(other) > 1
        for here, there in zip(one, other, strict=True):
            np.testing.assert_array_equal(here, there)
    finally:
        plt.close("all")
