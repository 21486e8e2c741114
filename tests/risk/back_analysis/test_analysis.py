"""Posterior of records and scales against one computed by hand, its symmetries and its bounds."""

import math

import numpy as np
import pytest
from scipy.special import ndtr

from rocksteady.calibration import ScanOptions
from rocksteady.errors import InputError
from rocksteady.risk.back_analysis._analysis import analyse
from tests.risk.back_analysis.toys import noise, toy_survey, toy_tried

RATIOS = np.exp(np.linspace(-0.6, 0.9, 12))
AT_ONE = np.stack([np.linspace(0.2, 0.6, 12), np.linspace(0.2, 0.6, 12) * RATIOS], axis=1)
THRESHOLDS = np.repeat(np.linspace(0.15, 0.9, 9)[:, np.newaxis], 12, axis=1)
FELL = [True, True, False, True, False, False, False, False, False]
ERRORS = noise(0.25, 0.04)
PLAIN = ScanOptions(temper=1.0, trials=0)


def test_the_posterior_is_that_of_a_threshold_with_a_lognormal_error() -> None:
    count = 400
    found = analyse(
        toy_survey(FELL), toy_tried(THRESHOLDS, AT_ONE, ERRORS, count=count), ERRORS, PLAIN
    )
    x = np.linspace(math.log(0.05), math.log(2.0), len(found.first_values))
    chance = 0.96 * ndtr((x - np.log(THRESHOLDS[:, :1])) / 0.25) + 0.02
    likelihood = np.prod(np.where(np.array(FELL)[:, np.newaxis], chance, 1.0 - chance), axis=0)
    by_hand = likelihood / likelihood.sum()
    # All records are alike but for their PGV: each has the same weight at each PGA.
    assert found.weights == pytest.approx(np.tile(by_hand / 12, (12, 1)), abs=3e-2 * by_hand.max())
    assert found.effective_records == pytest.approx(12.0)
    # The kernel of the density is 0.1 wide: the median of a wide posterior keeps its place.
    median = float(np.exp(np.interp(0.5, np.cumsum(by_hand), x)))
    assert found.medians[0] == pytest.approx(median, rel=0.02)


def test_a_temper_is_an_exponent_of_the_likelihood() -> None:
    tried = toy_tried(THRESHOLDS, AT_ONE, ERRORS)
    whole = analyse(toy_survey(FELL), tried, ERRORS, PLAIN)
    half = analyse(toy_survey(FELL), tried, ERRORS, ScanOptions(temper=0.5, trials=0))
    root = np.sqrt(whole.weights)
    assert half.weights == pytest.approx(root / root.sum(), rel=1e-9)
    assert half.region.sum() > whole.region.sum()
    assert math.isnan(half.plain_coverage)
    assert any("not checked" in text for text in half.warnings)


def test_stronger_objects_by_a_factor_move_the_result_by_it() -> None:
    factor = 1.7
    first = analyse(toy_survey(FELL), toy_tried(THRESHOLDS, AT_ONE, ERRORS), ERRORS, ScanOptions())
    limits = (factor * 0.05, factor * 2.0)
    other = analyse(
        toy_survey(FELL),
        toy_tried(factor * THRESHOLDS, AT_ONE, ERRORS, limits=limits),
        ERRORS,
        ScanOptions(),
    )
    for name in ("lows", "medians", "highs"):
        assert getattr(other, name) == pytest.approx(factor * getattr(first, name), rel=1e-6)
    assert other.weights == pytest.approx(first.weights, abs=1e-9)


def test_records_that_are_filed_larger_by_a_factor_change_scales_alone() -> None:
    first = analyse(toy_survey(FELL), toy_tried(THRESHOLDS, AT_ONE, ERRORS), ERRORS, ScanOptions())
    other = analyse(
        toy_survey(FELL), toy_tried(THRESHOLDS, 4.0 * AT_ONE, ERRORS), ERRORS, ScanOptions()
    )
    assert other.medians == pytest.approx(first.medians, rel=1e-12)
    scales = [[row["scale"] for row in found.record_rows()] for found in (first, other)]
    assert scales[0] == pytest.approx([4.0 * scale for scale in scales[1]], rel=1e-12)


def test_measures_in_the_other_order_give_the_same_region_but_for_its_grid() -> None:
    tried = toy_tried(THRESHOLDS, AT_ONE, ERRORS, limits=(0.02, 4.0))
    found = analyse(toy_survey(FELL), tried, ERRORS, PLAIN)
    # The region has its posterior probability, and no cell outside is likelier.
    cell = (np.diff(np.log(found.first_values))[0]) * (np.diff(np.log(found.ratios))[0])
    inside = found.density[found.region].sum() * cell
    assert inside == pytest.approx(0.9, abs=0.01)
    assert found.density.sum() * cell == pytest.approx(1.0, abs=1e-9)
    assert found.density[found.region].min() > found.density[~found.region].max()
    place = np.unravel_index(found.density.argmax(), found.density.shape)
    first = found.first_values[place[0]]
    assert found.contains(first, first * found.ratios[place[1]])
    low, high = found.first_values[[0, -1]].tolist()
    assert not found.contains(low, low * found.ratios[0])
    assert not found.contains(high, high * found.ratios[-1])
    beyond = ((0.99 * low, low), (1.01 * high, high), (0.0, 1.0), (np.nan, 1.0))
    wide = ((1.0, 0.99 * found.ratios[0]), (1.0, 1.01 * found.ratios[-1]), (1.0, 10**400))
    for number, (first, second) in enumerate((*beyond, *wide)):
        with pytest.raises(InputError, match=r"(second|first) = .* stay inside") as refused:
            found.contains(first, second)
        assert str(refused.value).startswith("second" if number >= len(beyond) else "first")


def test_where_nothing_fell_there_is_no_lower_bound() -> None:
    found = analyse(
        toy_survey([False] * 9), toy_tried(THRESHOLDS, AT_ONE, ERRORS), ERRORS, ScanOptions(seed=3)
    )
    assert found.bound == "upper bound"
    assert np.isnan(found.lows).all()
    # The chance that all nine stand is 0.1 there.
    x = math.log(found.highs[0])
    chance = 0.96 * ndtr((x - np.log(THRESHOLDS[:, 0])) / 0.25) + 0.02
    assert float(np.prod(1.0 - chance)) == pytest.approx(0.1, rel=0.1)
    assert "PGA likely below" in found.summary(more=True)
    assert any("no lower bound" in text for text in found.warnings)
    assert "bounds no PGA from above" in found.summary(more=True)


def test_records_that_leave_a_standing_object_at_any_scale_give_no_upper_bound() -> None:
    thresholds = THRESHOLDS.copy()
    thresholds[:, :4] = 50.0  # a third of the records topples nothing below the limit
    found = analyse(
        toy_survey([False] * 9), toy_tried(thresholds, AT_ONE, ERRORS), ERRORS, ScanOptions(seed=3)
    )
    assert np.isnan(found.highs[0])
    assert "without a bound" in found.describe().headline


def test_where_all_fell_there_is_a_lower_bound_whatever_the_upper_limit() -> None:
    bounds = []
    for top in (2.0, 8.0):
        tried = toy_tried(THRESHOLDS, AT_ONE, ERRORS, limits=(0.05, top), count=120)
        found = analyse(toy_survey([True] * 9), tried, ERRORS, ScanOptions())
        assert found.bound == "lower bound"
        assert np.isnan(found.highs).all()
        bounds.append(found.lows)
    assert bounds[0] == pytest.approx(bounds[1], rel=0.02)
    x = math.log(bounds[0][0])
    chance = 0.96 * ndtr((x - np.log(THRESHOLDS[:, 0])) / 0.25) + 0.02
    assert float(np.prod(chance)) == pytest.approx(0.1, rel=0.1)


@pytest.mark.parametrize("fell", [True, False])
def test_one_object_gives_a_bound_at_its_threshold(fell: bool) -> None:
    thresholds = np.full((1, 12), 0.4)
    exact = noise(0.1, 0.02)
    found = analyse(toy_survey([fell]), toy_tried(thresholds, AT_ONE, exact), exact, ScanOptions())
    # Where the chance is 0.1: 1.3 standard deviations of the error off the threshold.
    z = 0.1 * 1.3652
    wanted = 0.4 * math.exp(-z if fell else z)
    assert (found.lows if fell else found.highs)[0] == pytest.approx(wanted, rel=0.03)


def test_more_objects_narrow_the_region_and_the_interval() -> None:
    random = np.random.default_rng(5)
    areas, widths = [], []
    for count in (3, 30):
        thresholds = np.exp(random.normal(-1.0, 0.5, count))
        fell = (thresholds < 0.4).tolist()
        fell[0], fell[-1] = True, False
        tried = toy_tried(np.repeat(thresholds[:, np.newaxis], 12, axis=1), AT_ONE, ERRORS)
        found = analyse(toy_survey(fell), tried, ERRORS, ScanOptions(temper=1.0))
        areas.append(found.region.sum())
        widths.append(found.highs[0] / found.lows[0])
    assert areas[1] < areas[0]
    assert widths[1] < widths[0]


def test_a_result_at_a_limit_and_few_records_are_remarked_on() -> None:
    found = analyse(
        toy_survey(FELL),
        toy_tried(THRESHOLDS, AT_ONE, ERRORS, limits=(0.3, 2.0)),
        ERRORS,
        ScanOptions(),
    )
    assert any("reaches the lower limit of PGA" in text for text in found.warnings)
    assert any("12 records: fewer than 20" in text for text in found.warnings)
    free = analyse(toy_survey(FELL), toy_tried(THRESHOLDS, AT_ONE, ERRORS), ERRORS, ScanOptions())
    assert not any("limit" in text for text in free.warnings)
