"""Counts by level and record: what is joined, what is left out, and what they add up to."""

from typing import Any

import numpy as np
import pytest

from rocksteady.risk.fits._trial_counts import counts_of
from tests.every import every

AT = np.array([2.0, 1.0, 2.0, 3.0, 1.0])
TRIALS, LIFTED, FELL = [4, 3, 5, 0, 2], [3, 1, 5, 0, 0], [1, 0, 5, 0, 0]
GIVEN: list[tuple[str, Any]] = [("trials", TRIALS), ("uplifted", LIFTED), ("failures", FELL)]
GROUPS = ["b", "a", "a", "c", "b"]


@every("groups", [None, GROUPS])
def test_each_stage_counts_those_within_the_stage_before(groups: Any) -> None:
    uplift, fall = counts_of(AT, GIVEN, groups)
    # The level without a trial is none, nor is one where nothing lifts a level of the next stage.
    assert uplift.levels.tolist() == [1.0, 2.0]
    assert [part.tolist() for part in uplift.totals] == [[1.0, 8.0], [5.0, 9.0]]
    assert fall.levels.tolist() == [1.0, 2.0]
    assert [part.tolist() for part in fall.totals] == [[0.0, 6.0], [1.0, 8.0]]
    nothing = [("trials", TRIALS), ("uplifted", [3, 0, 5, 0, 0]), ("failures", FELL)]
    assert counts_of(AT, nothing, groups)[1].levels.tolist() == [2.0]


def test_records_are_groups_with_trials_or_each_trial_by_itself() -> None:
    uplift, fall = counts_of(AT, GIVEN, GROUPS)
    assert (uplift.records, fall.records) == (2, 2)
    uplift, fall = counts_of(AT, GIVEN, None)
    assert (uplift.records, fall.records) == (14, 9)
    # One cluster for each level and outcome, as often as it occurs: 2 levels of 3 outcomes.
    assert sorted(uplift.multiplicity.tolist()) == [1.0, 1.0, 2.0, 4.0, 6.0]
    assert uplift.trials.toarray().sum(axis=1).tolist() == [1.0] * 5


@every("groups", [None, GROUPS])
def test_both_limits_belong_to_the_range(groups: Any) -> None:
    for within, levels in (((1.0, 2.0), [1, 2]), ((1.0, 1.5), [1]), ((1.1, 2.0), [2])):
        (counts, _) = counts_of(AT, GIVEN, groups, within)
        assert counts.levels.tolist() == levels


def test_levels_are_one_up_to_a_rounding_apart() -> None:
    for part, count in ((1e-13, 1), (0.9e-12, 1), (1.2e-12, 2), (1e-11, 2)):
        at = np.array([1.0, 1.0 + part, 5.0])
        (counts,) = counts_of(at, [("trials", None), ("failures", [0, 1, 1])], None)
        assert len(counts.levels) == count + 1
        assert counts.levels[0] == 1.0
        assert counts.totals[1][0] == (2.0 if count == 1 else 1.0)


def test_a_place_is_named_where_more_fail_than_lift() -> None:
    with pytest.raises(ValueError, match=r"failures\[1\] = 2 .* above uplifted\[1\] = 1"):
        counts_of(AT, [*GIVEN[:2], ("failures", [1, 2, 5, 0, 0])], None)
