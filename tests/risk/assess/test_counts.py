"""Runs counted at a demand: the interval of the share that falls holds the true share."""

import math

import numpy as np
import pytest

from rocksteady.risk.assess._counts import Counts

RUNS = 6
"""Runs of a record at a level: both signs of it, and three restitutions."""


def counts_of(fell: list[int], lifted: list[int] | None = None) -> Counts:
    """Return the runs of some records at one level."""
    tried = [RUNS] * len(fell) if lifted is None else lifted
    return Counts(
        levels=np.array([0.4]),
        trials=np.full((len(fell), 1), RUNS),
        lifted=np.array(tried).reshape(-1, 1),
        fell=np.array(fell).reshape(-1, 1),
        without=0,
        measure=("PGV", "m/s"),
        given_uplift=True,
    )


@pytest.mark.parametrize("share", [0.05, 0.3, 0.8])
@pytest.mark.parametrize("records", [7, 24])
@pytest.mark.parametrize(("alike", "low", "high"), [(1.0, 0.83, 0.99), (0.6, 0.88, 1.0)])
def test_the_interval_holds_the_true_share_in_nine_of_ten_suites(
    share: float, records: int, alike: float, low: float, high: float
) -> None:
    """Records differ: all runs of one fall or none (`alike` is 1), or more or fewer of them do."""
    generator = np.random.default_rng(1971)
    held = 0
    for _ in range(400):
        chances = (generator.random(records) < share).astype(float)
        if alike < 1.0:
            chances = generator.beta(share / alike, (1.0 - share) / alike, records)
        band = counts_of(generator.binomial(RUNS, chances).tolist()).share_band(0)
        assert band is not None
        held += band[0] <= share <= band[1]
    assert low <= held / 400 <= high


def test_none_and_all_of_the_runs_have_an_interval_too() -> None:
    none, every = (counts_of([fell] * 12).share_band(0) for fell in (0, RUNS))
    assert none is not None
    assert every is not None
    assert none[0] == 0.0
    assert 0.0 < none[1] < 0.25
    assert every == pytest.approx((1.0 - none[1], 1.0))
    assert not any(map(math.isnan, (*none, *every)))


def test_records_without_a_run_that_lifts_say_nothing() -> None:
    few = counts_of([3, 0, 0, 0], [6, 0, 0, 0]).share_band(0)
    assert few == pytest.approx(counts_of([3]).share_band(0))
    assert counts_of([0, 0], [0, 0]).share_band(0) is None
