"""The form of stores: what an earlier version wrote is read, and a form to come is refused."""

import json
import zipfile
from pathlib import Path

import numpy as np
import pytest

import rocksteady as rs
from rocksteady.sweep.store._contents import DONE, FORM, GROUP, SCHEMA

WRITTEN = Path(__file__).with_name("written-0.1.0.zip")
"""A map of four by four cells in two chunks, as version 0.1.0 stored it."""


@pytest.fixture
def store(tmp_path: Path) -> Path:
    with zipfile.ZipFile(WRITTEN) as archive:
        archive.extractall(tmp_path)
    return tmp_path / "map.zarr"


def test_a_store_of_version_0_1_0_is_read(store: Path) -> None:
    found = rs.open_store(store)
    assert found.attrs["rocksteady_version"] == "0.1.0"
    assert found.amplitude.values.tolist() == [0.5, 1.0, 2.0, 3.0]
    assert found.kind.values.tolist() == [[2, 2, 2, 2], [2, 2, 2, 2], [3, 0, 0, 0], [3, 3, 3, 0]]
    assert found.highest.values[2].tolist()[1:] == [
        0.6329728681228524,
        0.31571645848841845,
        0.18549910598627356,
    ]
    assert np.isnan(found.highest.values[2, 0])
    words = found.kind.attrs["flag_meanings"].split()
    assert [words[code] for code in (0, 2, 3)] == ["symmetric", "rest", "overturned"]


def test_its_numbers_are_those_of_this_version(store: Path) -> None:
    found = rs.open_store(store)
    axes = {name: found[name].values.tolist() for name in ("amplitude", "frequency_ratio")}
    again = rs.map_attractors(rs.DimensionlessBlock(restitution=0.8), axes=axes)
    for name, variable in found.data_vars.items():
        np.testing.assert_array_equal(again[name].values, variable.values, err_msg=str(name))


def test_a_form_to_come_is_refused_with_both_names(store: Path) -> None:
    file = store / DONE / GROUP
    description = json.loads(file.read_text(encoding="utf-8"))
    assert description["attributes"][SCHEMA] == FORM
    description["attributes"][SCHEMA] = "rocksteady/store/2"
    file.write_text(json.dumps(description), encoding="utf-8")
    with pytest.raises(rs.errors.InputError, match="its form is rocksteady/store/2") as refusal:
        rs.open_store(store)
    assert FORM in str(refusal.value)
