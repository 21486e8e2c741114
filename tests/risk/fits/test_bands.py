"""Bands: their coverage on synthetic suites, their spread, their seeds and their limits."""

import math
from typing import Any

import numpy as np
import pytest
from scipy import stats

from rocksteady.risk import BandOptions, FragilityCurve, fit_curve
from tests.every import every
from tests.risk.fits.suites import MEDIAN, TOTAL_BETA, coverage, make_suite


def fitted(records: int, *, seed: int = 0, bands: BandOptions | None = None) -> FragilityCurve:
    suite = make_suite(records, seed=seed)
    return fit_curve(
        suite.intensity, suite.failures, groups=suite.record, bands=bands or BandOptions()
    )


def test_a_seed_has_one_band_and_another_seed_nearly_the_same() -> None:
    first, again, other = fitted(30), fitted(30), fitted(30, bands=BandOptions(seed=1))
    assert first.median_band == again.median_band
    assert first.beta_band == again.beta_band
    assert first.median_band != other.median_band
    assert first.median_band == pytest.approx(other.median_band, rel=0.05)
    assert first.beta_band == pytest.approx(other.beta_band, rel=0.1)
    for a, b in zip(
        first.probability_band(0.7) or (), again.probability_band(0.7) or (), strict=True
    ):
        assert a == b


def test_a_band_of_independent_trials_is_as_wide_as_fishers_information_has_it() -> None:
    """Without groups each trial is a record: the normal interval of a large sample."""
    import statsmodels.api as sm

    at = np.geomspace(0.2, 3.0, 12)
    trials = np.full(12, 400)
    failures = np.random.default_rng(0).binomial(trials, stats.norm.cdf(np.log(at / 0.7) / 0.5))
    found = fit_curve(at, failures, trials, bands=BandOptions(replicates=2000))
    binomial = sm.families.Binomial(sm.families.links.Probit())
    counts = np.column_stack([failures, trials - failures])
    glm = sm.GLM(counts, sm.add_constant(np.log(at)), family=binomial).fit()
    a, b = glm.params
    slope = np.array([-1.0 / b, a / b**2])
    error = math.sqrt(slope @ glm.cov_params() @ slope)
    assert found.median_band is not None
    width = math.log(found.median_band[1] / found.median_band[0])
    assert width == pytest.approx(2.0 * 1.645 * error, rel=0.08)
    assert found.beta_band is not None
    width = math.log(found.beta_band[1] / found.beta_band[0])
    assert width == pytest.approx(2.0 * 1.645 * math.sqrt(glm.cov_params()[1, 1]) / b, rel=0.08)


def test_records_and_not_trials_make_a_band() -> None:
    """Ten equal copies of each trial of a record tell no more than one."""
    suite = make_suite(30, seed=2)
    many = (np.tile(suite.intensity, 10), np.tile(suite.failures, 10))
    once = fit_curve(suite.intensity, suite.failures, groups=suite.record, bands=BandOptions())
    ten = fit_curve(*many, groups=np.tile(suite.record, 10), bands=BandOptions())
    assert ten.median_band == pytest.approx(once.median_band, rel=1e-8)
    assert ten.beta_band == pytest.approx(once.beta_band, rel=1e-8)
    loose = fit_curve(*many, bands=BandOptions())
    assert loose.median_band is not None
    assert once.median_band is not None
    assert np.ptp(loose.median_band) < 0.5 * np.ptp(once.median_band)


def test_names_of_records_and_the_order_of_rows_do_not_matter() -> None:
    suite = make_suite(25, seed=3)
    order = np.random.default_rng(0).permutation(len(suite.record))
    names = np.array([f"record {number:03d}" for number in suite.record])
    first = fit_curve(suite.intensity, suite.failures, groups=suite.record, bands=BandOptions())
    other = fit_curve(
        suite.intensity[order], suite.failures[order], groups=names[order], bands=BandOptions()
    )
    assert (first.median_band, first.beta_band) == (other.median_band, other.beta_band)


@pytest.mark.slow
@pytest.mark.parametrize("factor", [1e-6, 1e6])
def test_a_unit_scales_the_band(factor: float) -> None:
    suite = make_suite(25, seed=4)
    first = fit_curve(suite.intensity, suite.failures, groups=suite.record, bands=BandOptions())
    other = fit_curve(
        factor * suite.intensity, suite.failures, groups=suite.record, bands=BandOptions()
    )
    assert first.median_band is not None
    assert first.beta_band == pytest.approx(other.beta_band, rel=1e-7)
    scaled = [factor * end for end in first.median_band]
    assert other.median_band == pytest.approx(scaled, rel=1e-7)
    ends = np.array(first.probability_band([0.3, 0.7, 2.0]))
    others = np.array(other.probability_band(factor * np.array([0.3, 0.7, 2.0])))
    assert others == pytest.approx(ends, rel=1e-7)


def test_a_band_holds_the_curve_and_a_higher_confidence_holds_a_lower_one() -> None:
    found, wider = fitted(40), fitted(40, bands=BandOptions(confidence=0.99))
    at = np.geomspace(0.2, 2.0, 9)
    low, high = found.probability_band(at) or (at, at)
    lower, higher = wider.probability_band(at) or (at, at)
    curve = found.probability(at)
    assert ((lower < low) & (low < curve) & (curve < high) & (high < higher)).all()
    assert found.median_band is not None
    assert found.median_band[0] < found.median < found.median_band[1]
    zero, certain = (found.probability_band([0.0, math.inf]) or (at, at))[0]
    assert (zero, certain) == (0.0, 1.0)


def test_below_eleven_records_there_is_no_band_and_the_reason() -> None:
    found = fitted(10)
    assert found.status == "fitted"
    assert found.median_band is None
    assert found.probability_band(0.5) is None
    assert "there is no confidence band: 10 records, and it needs 11" in found.warnings
    assert fitted(11).median_band is not None


def overlapping_by(few: int) -> FragilityCurve:
    """Return the fit of 24 records of which so many fail below all others, and above them."""
    at = np.tile([1.0, 2.0, 3.0, 4.0], 24)
    records = np.repeat(np.arange(24), 4)
    capacity = np.where(records < few, 1.5, np.where(records < 2 * few, 3.5, 2.5))
    return fit_curve(at, (at > capacity).astype(int), groups=records, bands=BandOptions())


def test_redrawn_suites_without_a_curve_are_counted() -> None:
    found = overlapping_by(3)
    (words,) = [text for text in found.warnings if "redrawn" in text]
    assert words.endswith("are left out of the band, which is too narrow")
    # A suite is separated that has none of the three weak records, or none of the strong ones.
    expected = 2.0 * (21 / 24) ** 24 - (18 / 24) ** 24
    share = int(words.split()[0]) / 1000
    assert share == pytest.approx(expected, abs=4.0 * math.sqrt(expected / 1000))


def test_without_half_of_the_redrawn_suites_there_is_no_band() -> None:
    found = overlapping_by(1)  # 2 (23/24)^24 - (22/24)^24 = .60 of them are separated
    assert found.status == "fitted"
    assert found.probability_band(1.0) is None
    (words,) = [text for text in found.warnings if "redrawn" in text]
    assert words.startswith("there is no confidence band: ")


def test_a_curve_without_a_slope_is_bounded_as_clopper_and_pearson_have_it() -> None:
    levels = np.tile([1.0, 2.0], (12, 1))
    levels[0], levels[1] = (
        1.0,
        2.0,
    )  # so 11 of 12 records are tried at the lowest, and as many above
    at = np.array([0.5, 1.0, 1.5, 2.0, 3.0])
    many, few = 1.0 - 0.05 ** (1.0 / 12.0), 1.0 - 0.05 ** (1.0 / 11.0)
    for fell, low, high in (
        (levels < 0.0, [0.0] * 5, [many, many, few, few, 1.0]),
        (levels > 0.0, [0.0, 1.0 - few, 1.0 - few, 1.0 - many, 1.0 - many], [1.0] * 5),
        (levels > 1.0, [0.0, 0.0, 0.0, 1.0, 1.0], [0.0, 0.0, 1.0, 1.0, 1.0]),
    ):
        groups = np.repeat(np.arange(12), 2)
        curve = fit_curve(
            levels.ravel(), 1.0 * fell.ravel(), groups=groups, bands=BandOptions(confidence=0.95)
        )
        band = curve.probability_band(at)
        assert band is not None
        assert np.array(band) == pytest.approx(np.array([low, high]), rel=1e-12)


def test_scattered_intensities_have_a_band_too() -> None:
    suite = make_suite(40, seed=5, scatter=0.4)
    found = fit_curve(suite.intensity, suite.failures, groups=suite.record, bands=BandOptions())
    assert found.median_band is not None
    assert found.median_band[0] < MEDIAN < found.median_band[1]
    assert 0.1 < np.ptp(np.log(found.median_band)) < 0.6


@pytest.mark.slow
@pytest.mark.parametrize(("within", "suites", "draws"), [(0.0, 20, 1), (0.5, 40, 5)])
def test_bands_of_56_records_cover_what_they_promise(
    within: float, suites: int, draws: int
) -> None:
    """Of 90 %: above .83 but for what chance does to the suites, two standard deviations."""
    shares = coverage(56, suites, within=within, draws=draws)
    for name, share in shares.items():
        assert share > 0.83 - 2.0 * math.sqrt(0.09 / suites), (name, share)
    assert len(shares) == 5
    assert TOTAL_BETA > 0.0


@every(
    ("options", "name"),
    [
        ({"confidence": 1.0}, "confidence"),
        ({"confidence": math.nan}, "confidence"),
        ({"replicates": 99}, "replicates"),
        ({"replicates": 1000.0}, "replicates"),
        ({"replicates": 1}, "it must be 0 for no bands, or 100 or more"),
        ({"seed": -1}, "seed"),
    ],
)
def test_options_out_of_range_are_refused(options: dict[str, Any], name: str) -> None:
    with pytest.raises(ValueError, match=name):
        BandOptions(**options)
