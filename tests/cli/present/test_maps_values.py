"""What `map` prints of grids: counts, titles and what moves with an axis."""

from typing import Any

import numpy as np
import pytest
import xarray as xr
from rocksteady.cli.present.maps_values import (
    case_values,
    class_counts,
    map_values,
    print_counts,
    slabs,
    title_of,
)

from rocksteady import DimensionlessBlock, map_attractors, map_fates
from rocksteady.cli.console.progress import Meter
from rocksteady.cli.flags.block_and_shaking import BlockFlags, ShakingFlags
from rocksteady.cli.flags.map_axes import MapCase, MapStartFlags, map_case
from rocksteady.cli.present import maps_values
from tests.cli.present.printed import as_json, fits, printed

BARE = BlockFlags(restitution="0.8")
GRID = ShakingFlags(amplitude="0.5:6:12", frequency_ratio="1:12:9")


def grid_case() -> MapCase:
    return map_case(GRID, BARE, MapStartFlags())


def grid_of(case: MapCase, *, fates: bool = False) -> xr.Dataset:
    block = DimensionlessBlock(restitution=0.8)
    axes: dict[str, Any] = dict(case.axes)
    if fates:
        return map_fates(block, axes=axes, cycles=30)
    return map_attractors(block, axes=axes, max_cycles=200)


def values_of(case: MapCase, found: xr.Dataset) -> dict[str, Any]:
    meter = Meter(case.cells, lambda _: None)
    meter(0)
    meter(case.cells)
    return {**map_values(case, found, meter), "store": None}


def test_the_counts_are_those_of_the_grid() -> None:
    case = grid_case()
    found = grid_of(case)
    values = as_json(values_of(case, found))
    assert values["cells"] == values["computed"] == 12 * 9
    assert sum(values["counts"].values()) == 12 * 9
    assert values["counts"]["rest"] == int((found.kind == 2).sum()) > 0
    assert values["subharmonic"] == int((found.period > 1).sum()) > 0
    assert sum(values["subharmonic_counts"].values()) == values["subharmonic"]
    assert values["axes"]["amplitude"] == {"start": 0.5, "stop": 6.0, "count": 12}
    assert (values["amplitude"], values["frequency_ratio"]) == (None, None)
    assert (values["restitution"], values["start"]) == (0.8, "rest")


def test_fates_have_no_periods() -> None:
    case = grid_case()
    found = grid_of(case, fates=True)
    values = values_of(case, found)
    assert "subharmonic" not in values
    assert values["counts"]["overturned"] == int((found.fate == 2).sum()) > 0
    text = printed(print_counts, values)
    assert fits(text)
    assert text.splitlines()[1].split() == ["fate", "cells", "share"]


def test_any_slabs_count_the_same(monkeypatch: pytest.MonkeyPatch) -> None:
    case = grid_case()
    found = grid_of(case)
    whole = values_of(case, found)["counts"]
    monkeypatch.setattr(maps_values, "SLAB", 20)
    parts = list(slabs(found, "kind", "period"))
    assert [kind.shape for kind, _ in parts] == [(2, 9)] * 6
    np.testing.assert_array_equal(np.concatenate([kind for kind, _ in parts]), found.kind)
    assert values_of(case, found)["counts"] == whole


def test_subharmonic_motions_are_a_class_of_their_own() -> None:
    counts = {"symmetric": 5, "unsymmetric": 4, "aperiodic": 1, "undecided": 0}
    longer = {"symmetric": 2, "unsymmetric": 3}
    classes = class_counts({"counts": counts, "subharmonic_counts": longer})
    assert classes == {
        "symmetric": 3,
        "unsymmetric": 1,
        "subharmonic": 5,
        "aperiodic": 1,
        "undecided": 0,
    }
    assert list(classes)[2] == "subharmonic"
    assert class_counts({"counts": counts}) == counts


def test_the_table_has_a_row_a_class_that_occurs() -> None:
    case = grid_case()
    values = values_of(case, grid_of(case))
    text = printed(print_counts, {**values, "store": "map.zarr"})
    assert fits(text)
    assert text.startswith("108 cells: 12 amplitude x 9 frequency_ratio\n")
    for kind, count in class_counts(values).items():
        row = f"{kind:<12} {count:>4} {100.0 * count / 108:.2f} %"
        there = [line for line in text.splitlines() if line.split() == row.split()]
        assert len(there) == (count > 0)
    assert (
        f"subharmonic: of period 2 or longer, {values['subharmonic_counts']['symmetric']}" in text
    )
    assert "108 cells computed in" in text
    assert "kept in map.zarr" in text


SIZE = {"height_m": "1.5", "accel_g": "0.4", "freq_hz": "2"}


def sized_case(width: str, **more: Any) -> MapCase:
    shaking = ShakingFlags(accel_g=SIZE["accel_g"], freq_hz=SIZE["freq_hz"])
    return map_case(shaking, BlockFlags(width_m=width, height_m=SIZE["height_m"]), **more)


def test_what_moves_with_an_axis_has_no_one_value() -> None:
    wide = case_values(sized_case("0.3:0.6:3", start=MapStartFlags()))
    moving = {name for name, value in wide.items() if value is None}
    # A wider block is stockier and slower, and Housner's restitution follows.
    assert moving == {"block", "amplitude", "frequency_ratio", "restitution", "kick"}
    assert wide["accel_g"] == pytest.approx(0.4)
    kick = case_values(sized_case("0.3", start=MapStartFlags(phase="0:3:4")))
    assert {name for name, value in kick.items() if value is None} == {"phase", "kick"}
    asymmetric = BlockFlags(left_m=0.15, right_m=0.25, height_m="1.2")
    leaning = case_values(
        map_case(ShakingFlags(amplitude="1:2:3", frequency_ratio="2"), asymmetric, MapStartFlags())
    )
    assert {name for name, value in leaning.items() if value is None} == {
        "amplitude",
        "accel_g",
        "kick",
    }
    assert leaning["block"]["negative"]["alpha_rad"] > leaning["block"]["alpha_rad"]


def test_a_start_that_moves_is_no_one_start() -> None:
    shaking = ShakingFlags(amplitude="2", frequency_ratio="3")
    case = map_case(shaking, BARE, MapStartFlags(start="-1:1:5,0.2"))
    assert case_values(case)["start"] is None
    assert title_of(case, None, "linear") == (
        "What the block settles to: A = 2, Ω = 3, restitution 0.8"
    )


def test_a_title_says_all_that_is_no_axis() -> None:
    case = sized_case("0.3:0.6:3", start=MapStartFlags(phase="1"))
    assert title_of(case, 50, "nonlinear") == (
        "The block after 50 periods: 0.4 g, 2 Hz, Housner's restitution, from rest, phase 1 rad, "
        "nonlinear model"
    )
    assert title_of(grid_case(), None, "linear") == (
        "What the block settles to: restitution 0.8, from rest"
    )
