"""Tests together: counts, subsets, and remarks on what is unusual."""

from typing import Any

import numpy as np
import pytest

from rocksteady.errors import InputError
from rocksteady.model.motions.record import Record
from rocksteady.risk.observations.object_prior import ObjectPrior
from rocksteady.risk.observations.observations import Observations
from rocksteady.risk.observations.shaking_test import ShakingTest
from tests.every import every

COLUMN = ObjectPrior(name="column", width_m=0.15, height_m=0.6)
VASE = ObjectPrior(name="vase", alpha_rad=0.2, p_rad_s=4.0)


def record(name: str, samples: list[float] | None = None, dt_s: float = 0.01) -> Record:
    a = samples or [0.0, 2.0, -2.0, 0.0]
    return Record(acceleration_m_s2=np.array(a), dt_s=dt_s, name=name)


RECORDS = [record("a"), record("b")]


def made(**changed: Any) -> Observations:
    outcomes: list[bool | None] = [True, False, None, True]
    tests = [
        ShakingTest(
            **{
                "name": f"t{k}", "record": RECORDS[k % 2], "object": "column" if k < 3 else "vase",
                "fell": fell, **changed,
            }
        )
        for k, fell in enumerate(outcomes)
    ]  # fmt: skip
    return Observations(
        tests=tests, objects={"column": COLUMN, "vase": VASE, "unused": COLUMN}, sources={"a": "0"}
    )


def test_outcomes_groups_and_objects() -> None:
    shaken = made()
    np.testing.assert_array_equal(shaken.fell, [1.0, 0.0, np.nan, 1.0])
    assert shaken.groups.tolist() == ["a", "b", "a", "b"]
    assert list(shaken.objects) == ["column", "vase"]
    assert len(shaken) == 4
    values = shaken.to_dict()
    assert values["counts"] == {"fell": 2, "stood": 1, "unknown": 1}
    assert [row["outcome"] for row in values["rows"]] == ["fell", "stood", "unknown", "fell"]
    assert "4 tests of 2 objects on 2 records" in repr(shaken)


def test_subsets_keep_the_tests_their_objects_and_their_sources() -> None:
    shaken = made()
    for chosen in ([3, 0], np.array([3, 0], dtype=np.int8), [-1, -4]):
        part = shaken.subset(chosen)
        assert [test.name for test in part.tests] == ["t3", "t0"]
        assert part.sources == shaken.sources
    assert list(shaken.of("vase").objects) == ["vase"]
    assert [test.name for test in shaken.of("column").tests] == ["t0", "t1", "t2"]


@every("indices", [[4], [-5], [0.5], [[0]], [], ["t1"]])
def test_a_test_that_is_not_there_is_refused(indices: Any) -> None:
    with pytest.raises(InputError):
        made().subset(indices)


def test_names_are_told_apart_and_objects_are_there() -> None:
    (first, *_) = made().tests
    with pytest.raises(InputError, match="two tests have this name"):
        Observations(tests=[first, first], objects={"column": COLUMN})
    with pytest.raises(InputError, match="there must be one or more"):
        Observations(tests=[], objects={"column": COLUMN})
    with pytest.raises(InputError, match="did you mean colum"):
        Observations(tests=[first], objects={"colum": COLUMN})
    with pytest.raises(InputError, match=r"objects: column = 3 .* must be an ObjectPrior"):
        Observations(tests=[first], objects={"column": 3})  # type: ignore[dict-item]


def test_large_gains_moving_bases_and_coarse_records_are_remarked_on() -> None:
    assert any("2 tests scale a record by more than 10" in w for w in _warned(gain=10.5))
    assert any("by less than 1/10" in w for w in _warned(gain=0.09))
    assert _warned(gain=9.9) == ()
    pushed = record("pushed", [0.0, 2.0, -1.0, 0.0])  # half of its velocity stays
    (moving,) = _warned(record=pushed, group="g")
    assert moving.startswith("After 1 record the base still moves, as after pushed")
    # p of the vase is 4 rad/s, so that dt p = 0.1 at dt = 25 ms.
    (coarse,) = _warned(record=record("slow", dt_s=0.026), name="t", object="vase", one=True)
    assert "dt p is 0.104 in t, above 0.1" in coarse
    assert _warned(record=record("slow", dt_s=0.024), name="t", object="vase", one=True) == ()


def _warned(*, one: bool = False, **changed: Any) -> tuple[str, ...]:
    usual: dict[str, Any] = {"name": "t0", "record": RECORDS[0], "object": "column", "fell": True}
    tests = [ShakingTest(**(usual | changed))]
    if not one:
        tests.append(ShakingTest(**(usual | changed | {"name": "other"})))
    return Observations(tests=tests, objects={"column": COLUMN, "vase": VASE}).warnings


def test_subsets_from_the_first_place_to_the_last() -> None:
    shaken = made()
    assert [test.name for test in shaken.subset([-4, 3]).tests] == ["t0", "t3"]
    for wrong in ([4], [-5], [0, 4], [0.0], [[0]], 0):
        with pytest.raises(InputError, match="it must be a row of whole numbers from 0 to 3; give"):
            shaken.subset(wrong)
    with pytest.raises(InputError, match="there must be one or more"):
        shaken.subset([])
    with pytest.raises(InputError, match="objects are column, vase; give one"):
        shaken.of("unused")
