"""The accessor of datasets: any gridded result describes itself."""

from pathlib import Path

import numpy as np
import pytest
import xarray as xr

from rocksteady import Execution, open_store
from rocksteady.errors import ModelError
from rocksteady.sweep.cases import facts
from rocksteady.sweep.cases.facts import class_counts, flags_of, slabs
from rocksteady.sweeps import Axis, Grid, Output, evaluate
from tests.descriptions import fits


def area(width: np.ndarray, height: np.ndarray) -> dict[str, np.ndarray]:
    """Return two outputs."""
    return {"area": width * height, "tall": (height > width).astype(np.int8)}


GRID = Grid(
    axes=(
        Axis(name="width", values=[1.0, 2.0, 3.0], units="m"),
        Axis(name="height", values=[1.5, 2.5, 3.5, 4.5]),
    )
)
OUTPUTS = (
    Output(name="area", units="m2", long_name="area of the face"),
    Output(name="tall", dtype=np.int8, flags={0: "wide", 1: "tall"}, attrs={"infinitely_many": -1}),
)


def test_a_result_of_any_question_has_its_ranges_and_its_classes() -> None:
    data = evaluate(area, GRID, OUTPUTS)
    assert repr(data.rocksteady) == "<rocksteady gridded result: 12 cells: 3 width x 4 height>"
    values = data.rocksteady.to_dict()
    assert values["cells"] == 12
    assert values["axes"]["width"] == {"start": 1.0, "stop": 3.0, "count": 3}
    assert values["area"] == [1.5, 13.5]
    text = data.rocksteady.summary()
    assert fits(text)
    # By hand: of the heights 1.5 to 4.5 there are 4, 3 and 2 above the widths 1, 2 and 3.
    assert ["tall", "9", "75.00", "%"] in [line.split() for line in text.splitlines()]
    assert "<td" in data.rocksteady._repr_html_()
    assert data.tall.attrs["infinitely_many"] == -1
    with pytest.raises(ModelError, match="plot has no picture of a Dataset of no known kind"):
        data.rocksteady.plot()


def test_a_store_is_named_and_an_unfinished_one_counts_what_is_there(tmp_path: Path) -> None:
    path = tmp_path / "area.zarr"
    evaluate(area, GRID, OUTPUTS, run=Execution(store=path))
    data = open_store(path, partial=True)
    values = data.rocksteady.to_dict()
    assert (values["store"], values["computed"]) == (str(path), 12)
    assert data.tall.attrs["infinitely_many"] == -1


def test_slabs_of_any_height_count_the_same(monkeypatch: pytest.MonkeyPatch) -> None:
    rng = np.random.default_rng(1)
    codes = rng.integers(0, 3, size=(12, 9)).astype(np.int8)
    flags = {"flag_values": np.array([0, 1, 2], dtype=np.int8), "flag_meanings": "a b c"}
    data = xr.Dataset({"kind": (("y", "x"), codes, flags)})
    assert flags_of(data.kind) == {0: "a", 1: "b", 2: "c"}
    whole = class_counts(data, "kind")
    assert list(whole.values()) == np.bincount(codes.ravel()).tolist()
    monkeypatch.setattr(facts, "SLAB", 20)
    parts = list(slabs(data, "kind"))
    assert [part.shape for (part,) in parts] == [(2, 9)] * 6
    np.testing.assert_array_equal(np.concatenate([part for (part,) in parts]), codes)
    assert class_counts(data, "kind") == whole
