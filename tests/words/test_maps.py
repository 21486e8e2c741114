"""Words of maps: counts, titles, and what a store knows of itself."""

from pathlib import Path
from typing import Any

import numpy as np
import pytest
import xarray as xr

from rocksteady import (
    Block,
    DimensionlessBlock,
    Execution,
    Harmonic,
    Nonlinear,
    State,
    Steady,
    Store,
    map_attractors,
    map_fates,
    open_store,
)
from tests.descriptions import as_json, fits

BLOCK = DimensionlessBlock(restitution=0.8)
AXES: dict[str, Any] = {
    "amplitude": np.linspace(0.5, 6.0, 12),
    "frequency_ratio": np.linspace(1.0, 12.0, 9),
}


def test_the_counts_are_those_of_the_grid() -> None:
    found = map_attractors(BLOCK, axes=AXES, max_cycles=200)
    values = as_json(found.rocksteady.to_dict())
    assert values["cells"] == 12 * 9
    assert sum(values["counts"].values()) == 12 * 9
    assert values["counts"]["rest"] == int((found.kind == 2).sum()) > 0
    assert values["counts"]["subharmonic"] == int((found.period > 1).sum()) > 0
    assert sum(values["subharmonic_counts"].values()) == values["counts"]["subharmonic"]
    assert values["axes"]["amplitude"] == {"start": 0.5, "stop": 6.0, "count": 12}
    assert (values["restitution"], values["start"], values["model"]) == (0.8, "rest", "linear")
    assert (values["cycles"], values["fate"], values["store"]) == (200, False, None)
    text = found.rocksteady.summary(more=True)
    assert fits(text)
    lines = [line.split() for line in text.splitlines()]
    for kind, count in values["counts"].items():
        rows = [line for line in lines if line[:2] == [kind, str(count)] and line[-1] == "%"]
        assert len(rows) == (count > 0)


def test_fates_have_no_periods() -> None:
    found = map_fates(BLOCK, axes=AXES, cycles=30)
    values = found.rocksteady.to_dict()
    assert "subharmonic" not in values["counts"]
    assert values["counts"]["overturned"] == int((found.fate == 2).sum()) > 0
    text = found.rocksteady.summary(more=True)
    assert fits(text)
    assert ["fate", "cells", "share"] in [line.split() for line in text.splitlines()]
    assert repr(found.rocksteady).startswith("<rocksteady fate map: 108 cells")


def headline(found: xr.Dataset) -> str:
    return str(found.rocksteady.describe().headline)


def test_a_headline_has_all_that_is_no_axis() -> None:
    wide = map_fates(
        Block.rectangle(width=0.4, height=1.5),
        axes={
            "width": [0.3, 0.6],
            "restitution": "housner",
            "acceleration_m_s2": 0.4 * 9.80665,
            "frequency_hz": 2.0,
            "phase": 1.0,
        },
        cycles=20,
        model=Nonlinear(),
    )
    assert headline(wide) == (
        "The block after 20 periods: 0.4 g, 2 Hz, Housner's restitution, from rest, phase 1 rad, "
        "nonlinear model"
    )
    motion = Harmonic(amplitude=2.0, frequency_ratio=3.0)
    moved = map_attractors(
        BLOCK, motion, axes={"angle": [-0.5, 0.5]}, start=State(angle=0.0, velocity=0.2)
    )
    assert headline(moved) == (
        "What the block settles to: A = 2, Ω = 3, restitution 0.8, linear model"
    )
    kicked = map_attractors(BLOCK, motion, axes={"kick": [1e-3, 1e-2]}, start=Steady())
    assert "from steady" in headline(kicked)


def test_a_map_in_a_store_is_resumed_with_one_run_and_its_progress(tmp_path: Path) -> None:
    path = tmp_path / "map.zarr"
    given: dict[str, Any] = {"axes": AXES, "max_cycles": 200}
    cells: list[int] = []

    def stop(count: int) -> None:
        cells.append(count)
        if sum(cells) >= 40:
            raise KeyboardInterrupt

    store = Store(path, resume=True, chunk=9)
    with pytest.raises(KeyboardInterrupt):
        map_attractors(BLOCK, **given, run=Execution(executor="serial", store=store, progress=stop))
    part = open_store(path, partial=True).rocksteady.to_dict()
    assert 0 < part["computed"] < 108
    assert part["store"] == str(path)
    told: list[int] = []
    found = map_attractors(BLOCK, **given, run=Execution(store=store, progress=told.append))
    assert told[0] == part["computed"], "what is there is counted first"
    assert sum(told) == 108
    assert (
        found.rocksteady.to_dict()["counts"]
        == (map_attractors(BLOCK, **given).rocksteady.to_dict()["counts"])
    )
    assert open_store(path).rocksteady.summary(more=True) == found.rocksteady.summary(more=True)


def test_a_map_plots_itself() -> None:
    from matplotlib.figure import Figure

    found = map_fates(BLOCK, axes=AXES, cycles=30)
    axes = found.rocksteady.plot(Figure().add_subplot())
    assert axes.get_legend() is not None or axes.figure.legends


def test_infinitely_many_impacts_are_a_code_with_a_name() -> None:
    weak = DimensionlessBlock(restitution=0.4)
    axes = {"amplitude": np.linspace(1.05, 2.0, 8), "frequency_ratio": np.linspace(0.4, 3.0, 8)}
    found = map_attractors(weak, axes=axes)
    code = found.impacts.attrs["infinitely_many"]
    assert code == -1
    assert (found.impacts == code).any()
