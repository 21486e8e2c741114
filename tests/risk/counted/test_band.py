"""The interval of a counted share: Clopper-Pearson's, its ends, order and coverage."""

import itertools
import math
from fractions import Fraction
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.stats import beta, binom

from rocksteady.risk.counted.band import TAIL, records_to_show, share_band, upper_of_none
from tests.every import every
from tests.risk.counted.recorded import Floats, described, judged, real_suite

COVERED = 0.87
"""Least share of suites whose nominal 90 % interval holds the truth."""


def clopper_pearson(falls: float, trials: float) -> tuple[float, float]:
    """Return the interval by quantiles of the beta distribution."""
    low = 0.0 if falls <= 0 else float(beta.ppf(0.05, falls, trials - falls + 1.0))
    high = 1.0 if falls >= trials else float(beta.ppf(0.95, falls + 1.0, trials - falls))
    return low, high


@every("records", [1, 2, 7, 11, 14, 28, 56, 167])
def test_records_that_fall_or_not_have_the_interval_of_binomial_sums(records: int) -> None:
    """Each end is where the tail of the binomial distribution beyond the count is 5 %."""
    for falls in range(records + 1):
        low, high = share_band([1.0] * falls + [0.0] * (records - falls), 1)
        exact = clopper_pearson(falls, records)
        least = 1.0 - 0.05 ** (1.0 / records)
        assert (low, high) == pytest.approx(
            (min(exact[0], 1.0 - least), max(exact[1], least)), rel=1e-12, abs=1e-15
        )
        if falls > 0:
            assert binom.sf(falls - 1, records, exact[0]) == pytest.approx(0.05, rel=1e-9)
        if falls < records:
            assert binom.cdf(falls, records, exact[1]) == pytest.approx(0.05, rel=1e-9)


def test_more_falls_never_move_an_end_down() -> None:
    for records in (11, 28, 56):
        ends = np.array(
            [share_band([1.0] * k + [0.0] * (records - k), 1) for k in range(records + 1)]
        )
        assert (np.diff(ends, axis=0) >= -1e-15).all()
        assert (ends[1:-1, 0] > 0.0).all()
        assert ends[-1].tolist() == [pytest.approx(0.05 ** (1.0 / records)), 1.0]


SHARES = st.lists(st.integers(0, 5), min_size=2, max_size=60)


@given(SHARES)
def test_the_interval_is_that_of_a_number_of_trials_between_one_and_two_of_each_record(
    falls: list[int],
) -> None:
    """The number is p (1 - p) over the variance of the mean, in exact fractions."""
    shares = np.array(falls) / 5.0
    count, exact_shares = len(falls), [Fraction(fell, 5) for fell in falls]
    mean = sum(exact_shares, Fraction(0)) / count
    spread = sum((each - mean) ** 2 for each in exact_shares) / (count - 1) / count
    product = mean * (1 - mean)
    most = 2 * count if product else count  # of none and all each record is one
    trials = float(max(count, min(most, product / spread))) if spread else float(most)
    share = float(mean)
    low, high = share_band(shares, 5)
    least = upper_of_none(count)
    exact = clopper_pearson(share * trials, trials)
    assert low == pytest.approx(min(exact[0], 1.0 - least), rel=1e-9, abs=1e-12)
    assert high == pytest.approx(max(exact[1], least), rel=1e-9, abs=1e-12)
    assert low <= share <= high
    assert high >= least - 1e-15
    assert low <= 1.0 - least + 1e-15
    # Of standing in place of falling it is the mirror image, and order does not matter.
    mirrored = share_band(1.0 - shares, 5)
    assert mirrored == pytest.approx((1.0 - high, 1.0 - low), rel=1e-9, abs=1e-12)
    assert share_band(shares[::-1], 5) == pytest.approx((low, high), rel=1e-12, abs=1e-15)


def test_one_fall_never_shows_less_than_none() -> None:
    for records, ways in itertools.product(range(1, 170), (1, 2, 5, 10)):
        none = share_band([0.0] * records, ways)
        one = share_band([1.0 / ways] + [0.0] * (records - 1), ways)
        assert none == pytest.approx((0.0, upper_of_none(records)), rel=1e-12)
        assert one[1] >= none[1] * (1.0 - 1e-12)


def test_a_record_stands_for_two_trials_at_most_and_for_one_of_a_single_run() -> None:
    alike = [0.4, 0.6] * 28  # a variance far below the binomial one
    assert share_band(alike, 5) == pytest.approx(clopper_pearson(56.0, 112.0))
    assert share_band(alike, 2) == share_band(alike, 5)
    assert share_band(alike, 1) == pytest.approx(clopper_pearson(28.0, 56.0))
    apart = [0.0, 1.0] * 28  # the binomial variance: a record is one trial, whatever its runs
    assert share_band(apart, 5) == pytest.approx(clopper_pearson(28.0, 56.0))


@every(("records", "high"), [(7, 0.35), (11, 0.24), (14, 0.19), (28, 0.101), (56, 0.052),
                             (167, 0.018)])  # fmt: skip
def test_what_none_of_some_records_shows_is_what_the_binomial_law_says(
    records: int, high: float
) -> None:
    assert upper_of_none(records) == pytest.approx(high, abs=0.006)
    assert (1.0 - upper_of_none(records)) ** records == pytest.approx(TAIL, rel=1e-12)


def test_the_fewest_records_that_show_a_target_are_found_by_trying_all() -> None:
    targets = [*np.geomspace(1e-3, 0.999, 400), 0.5, 0.1, 0.05, 0.02, 0.01]
    beside = (1.0 - 1e-9, 1.0 + 1e-9)  # of what so many records show
    targets += [upper_of_none(count) * part for count in range(1, 200) for part in beside]
    for target in targets:
        fewest = next(count for count in itertools.count(1) if upper_of_none(count) < target)
        assert records_to_show(target) == fewest, target
    assert [records_to_show(each) for each in (0.1, 0.05, 0.02, 0.01)] == [29, 59, 149, 299]


# ------------------------------------------------------------------------------- coverage


def covered(bands: list[tuple[float, float]], share: float) -> float:
    return float(np.mean([low <= share <= high for low, high in bands]))


def least_coverage(draws: int, records: tuple[int, ...], ways: int = 5) -> tuple[float, ...]:
    """Return the least coverage, with records, correlation and share: beta-binomial records."""
    random = np.random.default_rng(0)
    worst: tuple[float, ...] = (1.0,)
    for count, alike, share in itertools.product(
        records, (0.3, 0.6, 0.9, 1.0), (0.02, 0.05, 0.1, 0.2, 0.5, 0.9, 0.98)
    ):
        size = (draws, count)
        if alike < 1.0:
            rest = 1.0 / alike - 1.0
            own = random.beta(share * rest, (1.0 - share) * rest, size)
            fell = random.binomial(ways, own) / ways
        else:
            fell = (random.random(size) < share).astype(np.float64)
        bands = [share_band(each, ways) for each in fell]
        worst = min(worst, (covered(bands, share), count, alike, share))
    return worst


def test_the_interval_holds_the_truth_of_beta_binomial_records() -> None:
    assert least_coverage(400, (11, 28)) >= (COVERED,)


@pytest.mark.slow
def test_the_interval_holds_the_truth_of_many_beta_binomial_suites() -> None:
    worst = least_coverage(800, (11, 14, 28, 56))
    print(worst)  # noqa: T201
    assert worst >= (COVERED,)


def shares_of_real_objects() -> list[Floats]:
    """Return the shares of each of 56 real records, of 12 objects at a demand each."""
    sizes = ((0.15, 0.45), (0.3, 1.5), (0.32, 1.8), (0.6, 1.8), (0.6, 2.0), (1.0, 3.2))
    found = []
    for width, height in sizes:
        slope = width / height
        p = math.sqrt(0.75 * 9.80665 / math.hypot(0.5 * width, 0.5 * height))
        for ratio, period in ((0.8, 0.13), (1.1, 0.2)):
            velocity = ratio * 9.80665 * slope / p
            demand: dict[str, Any] = {"pga_g": velocity / period / 9.80665, "pgv_m_s": velocity}
            count = judged(described(width, height, **demand), real_suite()).count
            assert count is not None
            found.append(count.fell / count.answered)
    return found


@pytest.mark.slow
def test_the_interval_of_suites_drawn_from_real_records_holds_the_share_of_all() -> None:
    """Of 12 objects, 500 suites of 11, 14 and 28 of their 56 records each."""
    random, least = np.random.default_rng(7), []
    objects = shares_of_real_objects()
    means = [float(each.mean()) for each in objects]
    assert len(objects) == 12
    assert len([each for each in means if 0.02 < each < 0.98]) >= 9
    for number, (shares, share) in enumerate(zip(objects, means, strict=True)):
        for size in (11, 14, 28):
            suites = [random.choice(shares, size, replace=True) for _ in range(500)]
            part = covered([share_band(each, 5) for each in suites], share)
            least.append((part, number, round(share, 3), size))
    print(sorted(least)[:5])  # noqa: T201
    assert min(least) >= (COVERED,)
