"""Datasets of branches, diagrams, sweeps and cascades: the numbers of their data frames."""

import math
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import xarray as xr

import rocksteady as rs
from rocksteady.dynamics.continuation.chains.point_types import PointType
from rocksteady.results.datasets import ColumnWords, padded, variables_of
from tests.every import every

BLOCK = rs.Block.rectangle(width=0.4, height=2.0, restitution=0.8)
MOTION = rs.Harmonic(amplitude=2.0, frequency_ratio=2.0)


@cache
def diagram() -> rs.branches.BifurcationDiagram:
    """Folds none, but breaking, doublings, overturning and branches of 2 and 4 flights."""
    return rs.find_bifurcations(
        BLOCK,
        MOTION,
        "frequency_ratio",
        within=(1.7, 2.2),
        values=9,
        search=rs.branches.BranchOptions(max_period=2, doublings=3),
    )


def results() -> dict[str, Any]:
    """One of each class."""
    whole = diagram()
    assert whole.cascade is not None
    found: dict[str, Any] = {"diagram": whole, "branch": whole.branches[-1]}
    return found | {"sweep": whole.sweeps[1], "cascade": whole.cascade}


@every("name", ["diagram", "branch", "sweep", "cascade"])
def test_a_dataset_comes_back_from_a_file_as_it_was(name: str, tmp_path: Path) -> None:
    data = results()[name].to_dataset()
    data.to_netcdf(tmp_path / "a.nc")
    with xr.open_dataset(tmp_path / "a.nc") as back:
        xr.testing.assert_equal(back, data)
        assert set(back.attrs) == set(data.attrs)
        for variable in data.variables:
            assert back[variable].attrs.get("units") == data[variable].attrs.get("units")
            meanings = data[variable].attrs.get("flag_meanings")
            assert back[variable].attrs.get("flag_meanings") == meanings
            assert meanings or "long_name" in data[variable].attrs or variable in rs_parameters()


def rs_parameters() -> set[str]:
    return {"amplitude", "frequency_ratio", "restitution"}


@every(
    ("name", "along"),
    [
        ("diagram", "point"),
        ("branch", "point"),
        ("sweep", "frequency_ratio"),
        ("cascade", "doubling"),
    ],
)
def test_the_rows_of_a_data_frame_are_the_values_of_the_dataset(name: str, along: str) -> None:
    result = results()[name]
    data, frame = result.to_dataset(), result.to_dataframe()
    assert data.sizes[along] == len(frame) > 1
    shared = set(frame) & {str(name) for name in data.variables}
    assert (
        shared
        >= {
            "diagram": {"branch", "type", "stable", "multiplier_1_re", "highest", "freq_hz"},
            "branch": {"type", "amplitude", "stable", "multiplier_2_im", "lowest", "arclength"},
            "sweep": {"kind", "period", "highest", "lowest", "frequency_ratio"},
            "cascade": {"frequency_ratio", "period", "distance", "ratio"},
        }[name]
    )
    for column in shared:
        values = data[column].values
        if "flag_meanings" in data[column].attrs:
            words = np.array(data[column].attrs["flag_meanings"].split())
            assert words[values].tolist() == frame[column].tolist(), column
        else:
            expected = frame[column].astype(float).fillna(math.nan if values.dtype == float else 0)
            assert values.astype(float) == pytest.approx(expected.to_numpy(), nan_ok=True), column


def test_flights_of_shorter_orbits_end_in_nan_and_lean_as_their_extremes_do() -> None:
    data = diagram().to_dataset()
    known = np.isfinite(data.peaks).sum("flight")
    assert set(known.values.tolist()) == {2, 4}
    assert data.peaks.max("flight").values == pytest.approx(data.highest.values)
    assert data.peaks.min("flight").values == pytest.approx(data.lowest.values)
    assert (data.branch.diff("point") >= 0).all()


def test_bifurcations_stand_once_each_with_their_types() -> None:
    whole = diagram()
    data = whole.to_dataset()
    words = data.bifurcation_type.attrs["flag_meanings"].split()
    assert [words[code] for code in data.bifurcation_type.values] == [
        each.point.type.value for each in whole.points
    ]
    assert data.bifurcation_frequency_ratio.values.tolist() == [
        each.point.frequency_ratio for each in whole.points
    ]
    assert words == [kind.value for kind in PointType]


def test_codes_of_a_sweep_are_those_of_a_map() -> None:
    sweep = diagram().sweeps[0]
    data = sweep.to_dataset()
    found = rs.map_attractors(BLOCK, MOTION, axes={"frequency_ratio": sweep.values})
    words = found.kind.attrs["flag_meanings"].split()
    assert words[: len(data.kind.attrs["flag_values"])] == data.kind.attrs["flag_meanings"].split()
    overturned = data.kind == words.index("overturned")
    assert overturned.any()
    assert data.highest.where(overturned, drop=True).isnull().all()
    assert (data.period.where(overturned, drop=True) == 0).all()


def test_a_diagram_without_branches_is_an_empty_dataset() -> None:
    none = rs.find_bifurcations(
        rs.DimensionlessBlock(restitution=0.8), MOTION, "amplitude", within=(0.01, 0.02), values=0
    )
    data = none.to_dataset()
    assert (data.sizes["point"], data.sizes["flight"], data.sizes["bifurcation"]) == (0, 0, 0)
    assert "0 branches" in repr(none)


def test_every_representation_is_one_line() -> None:
    whole = diagram()
    for each in (*results().values(), whole.branches[0].points[0], whole.points[0], whole.search):
        assert "\n" not in repr(each)
        assert len(repr(each)) < 240
    assert f"{len(whole.branches)} branches, {len(whole.points)} bifurcations" in repr(whole)


def test_what_is_missing_has_a_value_of_its_own() -> None:
    words = {
        "count": ColumnWords(long_name="a count", missing=0),
        "size": ColumnWords(long_name="a size", units="m"),
        "word": ColumnWords(long_name="a word", flags=("a", "b")),
        "not there": ColumnWords(long_name="nothing"),
    }
    rows: list[dict[str, Any]] = [
        {"count": 3, "size": None, "word": "b"},
        {"count": None, "size": 2.0, "word": "a"},
    ]
    found = xr.Dataset(variables_of(rows, "row", words))
    assert set(found) == {"count", "size", "word"}
    assert (found["count"].values.tolist(), found.word.values.tolist()) == ([3, 0], [1, 0])
    assert found["size"].values == pytest.approx([math.nan, 2.0], nan_ok=True)
    assert found["count"].attrs["missing"] == 0
    assert padded([]).shape == (0, 0)
    with pytest.raises(ValueError, match="not in tuple"):
        variables_of([{"word": "c"}], "row", words)
