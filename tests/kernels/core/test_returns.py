"""References of motions that repeat: when one is replaced, met again, and leapt from."""

import numpy as np

from rocksteady.kernels.core.returns import (
    LEAPT,
    PERIODIC,
    REFERENCE_FIELDS,
    Passage,
    Reference,
    compared,
    leapt,
)
from tests.every import every


@every(
    ("velocity", "first", "places"),
    [
        (1.0, 0.0, [10, 21, 34, 48, 64, 83]),  # n - r >= 8 + n/8
        (0.0, 0.0, [64, 192, 448]),  # n - r >= 64 + r, of an uplift
        (0.0, 10.0, [84, 232, 528]),
    ],
)
def test_a_reference_that_is_not_met_again_is_replaced_later_each_time(
    velocity: float, first: float, places: list[int]
) -> None:
    reference = Reference(0.0, velocity, 1000.0, first, 0.0, 0.0)
    seen = []
    for impacts in range(int(first) + 1, places[-1] + 1):
        now = Passage(1.0, velocity, 1000.0 - impacts, float(impacts))
        before, reference = reference, compared(reference, 1.0, True, now)
        assert reference.lag == 0.0
        if reference.impacts != before.impacts:
            assert reference[:4] == now
            seen.append(impacts)
        else:
            assert reference == before
    assert seen == places


@every(
    ("gaps", "lags"),
    [
        ([0.06, 0.04, 1e-6, 2e-12], [0.0, 2.0, 2.0, PERIODIC]),
        ([0.04, 0.04, 0.06], [1.0, 1.0, 0.0]),
        ([0.04, 5e-12], [1.0, PERIODIC]),
        ([0.04, 2e-11], [1.0, 1.0]),  # not the same yet
        ([5.25e-11, 5e-12], [1.0, PERIODIC]),
        ([5e-12, 2e-12, 1e-12], [1.0, 1.0, 1.0]),  # not ten times as close
        ([9e-13, 8e-14], [1.0, 1.0]),  # both are rounding
    ],
)
def test_a_motion_repeats_that_comes_back_ever_closer(gaps: list[float], lags: list[float]) -> None:
    reference = Reference(0.0, 1.0, 1000.0, 0.0, 0.0, 0.0)
    impacts, seen, widest = 0.0, [], 0.0
    for gap in gaps:
        lag = reference.lag
        impacts = reference.impacts + max(lag, 1.0) if lag else impacts + 1.0
        now = Passage(gap, 1.0, 1000.0 - impacts, impacts)
        reference = compared(reference, gap, True, now)
        seen.append(reference.lag)
        if lag:
            widest = max(widest, gap)
        elif gap < 0.05:
            widest = gap
        if reference.lag > 0.0:
            assert reference == Reference(*now, reference.lag, widest)
    assert seen == lags


def test_nothing_is_compared_between_two_impacts_nor_without_time_gone_by() -> None:
    reference = Reference(0.0, 1.0, 1000.0, 3.0, 2.0, 0.04)
    back = Passage(0.0, 1.0, 990.0, 5.0)
    assert compared(reference, 1e-13, True, back).lag == PERIODIC
    assert compared(reference, 1e-13, False, back) == reference
    assert compared(reference, 1e-13, True, back._replace(left=1000.0)).lag == 2.0


def test_a_block_that_just_lifts_repeats_at_the_next_uplift() -> None:
    reference = Reference(0.5, 0.0, 1000.0, 3.0, 0.0, 0.0)
    assert compared(reference, 1e-12, True, Passage(0.5, 0.0, 990.0, 5.0)).lag == PERIODIC
    assert compared(reference, 1e-12, True, Passage(0.5, 1e-9, 990.0, 5.0)).lag == 0.0


@every(
    ("left", "times"),
    [(90.0, 8), (31.0, 2), (20.0, 1), (19.0, 0), (3.0, 0)],  # of 10 half cycles, but the last
)
def test_what_repeats_leaps_over_all_whole_periods_but_the_last(left: float, times: int) -> None:
    count = 3
    lanes = np.zeros((REFERENCE_FIELDS, count))
    lanes[:, 1] = Reference(0.5, 1.5, left + 10.0, 7.0, PERIODIC, 1e-3)
    now = Passage(0.5, 1.5, left, 11.0)
    after = leapt(lanes.ravel(), 1, count, now)
    assert after == Passage(0.5, 1.5, left - 10.0 * times, 11.0 + 4.0 * times)
    assert lanes[4].tolist() == [0.0, LEAPT, 0.0]
    assert leapt(lanes.ravel(), 1, count, now) == now  # once
