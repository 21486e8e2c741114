"""Sentences on an ensemble: each from its own limit on, with the numbers that it counts."""

import json

import numpy as np
import pytest

from rocksteady import Record, Status
from rocksteady.risk.ensemble._labels import warnings_of
from tests.every import every

SUITE = [Record(acceleration_m_s2=np.array([0.0, 1.0, -1.0 - k, 0.0]), dt_s=0.1) for k in range(8)]
NAMES = [f"r{k}" for k in range(8)]


def told(
    records: list[Record] = SUITE, scale: np.ndarray | None = None, status: np.ndarray | None = None
) -> list[str]:
    count = len(records)
    factors = np.ones((2, count, 3)) if scale is None else scale
    ends = np.full((2, count, 3), int(Status.AT_REST)) if status is None else status
    copied = np.zeros((count, 2), dtype=bool)
    found: list[str] = json.loads(warnings_of(NAMES[:count], records, factors, ends, copied))
    return found


def test_a_clean_ensemble_has_none() -> None:
    assert told() == []
    slower = Record(acceleration_m_s2=SUITE[0].acceleration_m_s2, dt_s=0.2)
    assert told([SUITE[0], slower]) == []


@every(("copies", "listed"), [(2, "r0, r1"), (5, "r0, r1, r2, r3, r4"), (7, "r0, r1, r2, r3, r4")])
def test_records_of_the_same_samples_are_named_up_to_five(copies: int, listed: str) -> None:
    (words,) = told([*[SUITE[0]] * copies, SUITE[3]])
    assert words.startswith(f"{listed} hold the same samples: they count as {copies} records")


def test_scaling_is_remarked_on_beyond_ten_with_the_record_that_is_scaled_most() -> None:
    scale = np.ones((2, 8, 3))
    scale[1, 5, 2] = 10.0
    assert told(scale=scale) == []
    scale[1, 5, 2], scale[0, 2, 1] = 10.5, 24.0
    (words,) = told(scale=scale)
    assert words.startswith("Records are scaled by up to 24 (r2), in 4 % of the runs by more than")
    assert "by more than 10:" in words


@pytest.mark.parametrize("outcome", [Status.LOST_CONTACT, Status.UNDECIDED])
def test_runs_without_an_answer_are_counted(outcome: Status) -> None:
    status = np.full((2, 8, 3), int(Status.OVERTURNED))
    status[0, :5, 0] = int(outcome)
    (words,) = told(status=status)
    assert words == f"5 of 48 runs ended {outcome.label}, without an answer."
