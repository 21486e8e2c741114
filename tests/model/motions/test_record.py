"""Records: samples that are copied, validated, scaled and reversed."""

import dataclasses
import math
import pickle
import re
from typing import Any

import numpy as np
import pytest

from rocksteady import Record
from rocksteady.errors import InputError
from tests.every import every

VALUES = [0.0, 1.5, -3.0, 0.5]


def test_a_record_keeps_a_copy_that_cannot_be_changed() -> None:
    given = np.array(VALUES)
    record = Record(acceleration_m_s2=given, dt_s=0.02, name="a")
    given[0] = 9.0
    assert record.acceleration_m_s2.tolist() == VALUES
    with pytest.raises(ValueError, match="read-only"):
        record.acceleration_m_s2[0] = 1.0
    with pytest.raises(dataclasses.FrozenInstanceError):
        record.dt_s = 0.01  # type: ignore[misc]


def test_what_a_record_says_of_itself() -> None:
    record = Record(acceleration_m_s2=np.array(VALUES, dtype=np.float32), dt_s=0.02)
    assert record.acceleration_m_s2.dtype == np.float64
    assert record.peak_acceleration_m_s2 == 3.0
    assert record.duration_s == pytest.approx(0.06)
    assert repr(record) == "Record(name=None, samples=4, dt_s=0.02, peak_acceleration_m_s2=3)"


def test_scaled_and_reversed() -> None:
    record = Record(acceleration_m_s2=np.array(VALUES), dt_s=0.02, name="a")
    other = record.scaled(0.5).reversed()
    assert other.acceleration_m_s2.tolist() == [0.0, -0.75, 1.5, -0.25]
    assert (other.dt_s, other.name) == (0.02, "a")
    assert record.reversed().reversed() == record


def test_equal_records_are_equal_and_have_one_hash() -> None:
    one = Record(acceleration_m_s2=np.array(VALUES), dt_s=0.02)
    same = Record(acceleration_m_s2=np.array(VALUES), dt_s=0.02)
    assert one == same
    assert hash(one) == hash(same)
    for other in (one.scaled(2.0), dataclasses.replace(one, dt_s=0.01), "a record"):
        assert one != other
    assert pickle.loads(pickle.dumps(one)) == one


@every(
    ("value", "why"),
    [
        ([], "two samples or more"),
        ([1.0], "two samples or more"),
        ([0.0, 0.0, 0.0], "all samples are zero; give a Still()"),
        ([0.0, math.nan], "sample 1 is not a finite number"),
        ([-math.inf, 0.0], "sample 0 is not a finite number"),
        (1.0, "one row of numbers"),
        ([[1.0, 2.0], [3.0, 4.0]], "one row of numbers"),
        ([[1.0, 2.0], [3.0]], "one row of numbers"),
        (["1", "2"], "one row of numbers"),
        ([True, False], "one row of numbers"),
        ([1.0 + 2.0j, 0.0], "one row of numbers"),
        (None, "one row of numbers"),
    ],
)
def test_bad_samples_are_refused(value: Any, why: str) -> None:
    with pytest.raises(InputError, match=f"^acceleration_m_s2 = .*{re.escape(why)}"):
        Record(acceleration_m_s2=value, dt_s=0.02)


@every(
    ("name", "value"),
    [("dt_s", 0.0), ("dt_s", -0.01), ("dt_s", math.nan), ("dt_s", "0.01"), ("name", 3)],
)
def test_a_bad_interval_or_name_is_refused(name: str, value: Any) -> None:
    arguments: dict[str, Any] = {"acceleration_m_s2": VALUES, "dt_s": 0.02, name: value}
    with pytest.raises(InputError, match=f"^{name} = "):
        Record(**arguments)


@every("factor", [0.0, 5e-324, -1e-60, math.inf, math.nan, "2"])
def test_a_bad_factor_is_refused(factor: Any) -> None:
    with pytest.raises(InputError, match=r"^factor = "):
        Record(acceleration_m_s2=np.array(VALUES), dt_s=0.02).scaled(factor)
