"""Motions at a demand: both peaks exactly, vertical and floors with them, and what is refused."""

import math
from dataclasses import replace

import numpy as np
import pytest

from rocksteady import BaseMotion, Record
from rocksteady.errors import InputError
from rocksteady.measures import Measure, compute_measure
from rocksteady.motions import Floor, make_synthetic_suite
from rocksteady.risk.counted.motions import (
    Motion,
    across,
    changed,
    distinct,
    folds,
    has_vertical,
    median_fold,
    with_vertical_peak,
)
from rocksteady.risk.counted.suite import Peaks, Suite
from tests.every import every
from tests.risk.counted.recorded import RACKS, Floats, G, real_suite

SUITE = make_synthetic_suite(8, seed=5)
PAIRS = [
    BaseMotion(one, Record(acceleration_m_s2=0.6 * other.acceleration_m_s2, dt_s=2.0 * other.dt_s))
    for one, other in zip(SUITE, reversed(SUITE), strict=True)
]
FLOOR = Floor(**RACKS)
BOTH = Peaks(pga_g=0.37, pgv_m_s=0.44)


def peaks_of(record: Record) -> tuple[float, float]:
    """Return PGA [g] and PGV [m/s] by sums of their own: the velocity is exact on straight lines.

    A line between two samples has its largest velocity at a sample or where it crosses zero.
    """
    a, dt = record.acceleration_m_s2, record.dt_s
    v = np.concatenate([[0.0], np.cumsum(0.5 * dt * (a[1:] + a[:-1]))])
    most = float(np.abs(v).max())
    for k in np.flatnonzero(a[:-1] * a[1:] < 0.0):
        part = a[k] / (a[k] - a[k + 1])
        most = max(most, abs(float(v[k] + 0.5 * part * dt * a[k])))
    return float(np.abs(a).max()) / G, most


def measured(motions: list[Record]) -> Floats:
    return np.array([peaks_of(record) for record in motions])


@every("demand", [BOTH, Peaks(pga_g=0.02, pgv_m_s=5.0), Peaks(pga_g=9.0, pgv_m_s=0.01)])
def test_every_motion_has_both_peaks_of_the_demand(demand: Peaks) -> None:
    """By their own integration, and by the measures of the package: to 1e-12."""
    pga, pgv = demand.pga_g or 0.0, demand.pgv_m_s or 0.0
    shaking = Suite(motions=SUITE).at(demand)
    records = [across(each) for each in shaking.motions]
    found = measured(records)
    np.testing.assert_allclose(found[:, 0], pga, rtol=1e-12)
    np.testing.assert_allclose(found[:, 1], pgv, rtol=1e-9)
    for record in records:
        assert compute_measure(record, Measure("pga_g")) == pytest.approx(demand.pga_g, rel=1e-12)
        assert compute_measure(record, Measure("pgv_m_s")) == pytest.approx(
            demand.pgv_m_s, rel=1e-12
        )
    own = measured(SUITE)
    np.testing.assert_allclose(shaking.scales, pga / own[:, 0], rtol=1e-12)
    kept = pgv / own[:, 1] / shaking.scales
    np.testing.assert_allclose(shaking.stretches, kept, rtol=1e-9)
    assert (shaking.measure, shaking.level) == (Measure("pga_g"), demand.pga_g)
    assert shaking.stretched
    assert shaking.other is None
    assert shaking.demand == demand
    np.testing.assert_allclose(shaking.floor_pga_g, pga, rtol=1e-12)


def test_real_records_have_both_peaks_of_the_demand() -> None:
    shaking = Suite(motions=real_suite()).at(BOTH)
    for each in shaking.motions:
        for name, value in (("pga_g", BOTH.pga_g), ("pgv_m_s", BOTH.pgv_m_s)):
            assert compute_measure(across(each), Measure(name)) == pytest.approx(value, rel=1e-12)


def test_its_shape_is_that_of_the_record_and_time_alone_is_longer() -> None:
    shaking = Suite(motions=SUITE).at(BOTH)
    rows = zip(SUITE, shaking.motions, shaking.scales, shaking.stretches, strict=True)
    for record, made, scale, stretch in rows:
        assert isinstance(made, Record)
        assert (made.name, made.ground) == (record.name, None)
        np.testing.assert_allclose(
            made.acceleration_m_s2, scale * record.acceleration_m_s2, rtol=1e-14
        )
        assert made.dt_s == pytest.approx(stretch * record.dt_s, rel=1e-14)


def test_the_vertical_component_has_the_same_factors_of_size_and_time() -> None:
    shaking = Suite(motions=PAIRS).at(BOTH)
    assert all(map(has_vertical, shaking.motions))
    rows = zip(PAIRS, shaking.motions, shaking.scales, shaking.stretches, strict=True)
    for pair, made, scale, stretch in rows:
        assert isinstance(made, BaseMotion)
        assert isinstance(made.vertical, Record)
        assert isinstance(pair.vertical, Record)
        up = pair.vertical
        np.testing.assert_allclose(
            made.vertical.acceleration_m_s2, scale * up.acceleration_m_s2, rtol=1e-14
        )
        assert made.vertical.dt_s == pytest.approx(stretch * up.dt_s, rel=1e-14)
        assert peaks_of(across(made)) == pytest.approx((BOTH.pga_g, BOTH.pgv_m_s), rel=1e-9)
    mixed = Suite(motions=[PAIRS[0], SUITE[1], BaseMotion(SUITE[2])])
    assert [*map(has_vertical, mixed.at(BOTH).motions)] == [True, False, False]
    assert [*map(has_vertical, mixed.at(BOTH, vertical_g=0.1).motions)] == [True]


@every("demand", [BOTH, Peaks(pga_g=0.37), Peaks(pgv_m_s=0.44)])
def test_a_stated_vertical_peak_is_that_of_every_vertical_component(demand: Peaks) -> None:
    """At the demand, where motions that are not stretched are still to be scaled."""
    shaking = Suite(motions=PAIRS).at(demand, vertical_g=0.2)
    left = np.ones(len(PAIRS)) if shaking.stretched else shaking.scales
    for pair, made, factor in zip(PAIRS, shaking.motions, left, strict=True):
        assert isinstance(pair.vertical, Record)
        assert isinstance(made, BaseMotion)
        assert isinstance(made.vertical, Record)
        up = factor * made.vertical.acceleration_m_s2
        assert np.abs(up).max() == pytest.approx(0.2 * G)
        own = pair.vertical.acceleration_m_s2
        np.testing.assert_allclose(up, 0.2 * G / np.abs(own).max() * own, rtol=1e-12)
    assert with_vertical_peak(SUITE[0], 0.2) is SUITE[0]


def test_a_floor_answers_the_ground_that_is_stretched_already() -> None:
    """Not the other way: a floor's own period would be stretched with it."""
    shaking = Suite(motions=SUITE).at(BOTH, floor=FLOOR)
    for record, made, scale, stretch in zip(
        SUITE, shaking.motions, shaking.scales, shaking.stretches, strict=True
    ):
        ground = Record(
            acceleration_m_s2=scale * record.acceleration_m_s2, dt_s=stretch * record.dt_s
        )
        expected = FLOOR.motion(ground)
        assert isinstance(made, Record)
        np.testing.assert_allclose(
            made.acceleration_m_s2, expected.acceleration_m_s2, rtol=1e-9, atol=1e-9
        )
        assert made.dt_s == pytest.approx(expected.dt_s, rel=1e-12)
        assert made.ground is not None
        assert peaks_of(made.ground) == pytest.approx((BOTH.pga_g, BOTH.pgv_m_s), rel=1e-9)
        later = changed(FLOOR.motion(record), float(scale), float(stretch))
        assert abs(across(later).peak_acceleration_m_s2 / made.peak_acceleration_m_s2 - 1.0) > 1e-4
    peaks = [across(each).peak_acceleration_m_s2 / G for each in shaking.motions]
    np.testing.assert_allclose(shaking.floor_pga_g, peaks)
    assert max(peaks) > 1.2 * (BOTH.pga_g or 0.0)


@every(
    ("demand", "stretch", "measure", "other"),
    [
        (Peaks(pga_g=0.37), True, "pga_g", "pgv_m_s"),
        (Peaks(pgv_m_s=0.44), True, "pgv_m_s", "pga_g"),
        (BOTH, False, "pga_g", "pgv_m_s"),
    ],
)
def test_with_one_peak_accelerations_alone_are_scaled_and_the_other_has_a_range(
    demand: Peaks, stretch: bool, measure: str, other: str
) -> None:
    for motions in (SUITE, PAIRS):
        suite: list[Motion] = [*motions]
        shaking = Suite(motions=suite).at(demand, stretch=stretch)
        # The motions are those given: an ensemble scales them to the level.
        assert all(one is two for one, two in zip(shaking.motions, suite, strict=True))
        assert not shaking.stretched
        assert (shaking.stretches == 1.0).all()
        assert (shaking.measure, shaking.level) == (Measure(measure), getattr(demand, measure))
        own = measured([across(each) for each in suite])
        column = 0 if measure == "pga_g" else 1
        np.testing.assert_allclose(shaking.scales * own[:, column], shaking.level, rtol=1e-9)
        assert shaking.other is not None
        name, low, high = shaking.other
        assert name == Measure(other)
        beside = shaking.level / own[:, column] * own[:, 1 - column]
        assert (low, high) == pytest.approx(np.quantile(beside, [0.1, 0.9]), rel=1e-9)
        np.testing.assert_allclose(
            shaking.floor_pga_g, shaking.scales * own[:, 0], rtol=1e-12
        )  # where it stands on the ground


def test_motions_of_a_floor_have_no_second_peak_to_be_stretched_to() -> None:
    led = [FLOOR.motion(each) for each in SUITE]
    with pytest.raises(InputError, match="those of a floor: motions of the ground are stretched"):
        Suite(motions=led).at(BOTH)
    with pytest.raises(InputError, match="those of a floor"):
        Suite(motions=[*SUITE, BaseMotion(led[0])]).at(BOTH)
    with pytest.raises(InputError, match="those of a floor"):
        Suite(motions=led).at(Peaks(pga_g=0.37), floor=FLOOR)
    # One peak, or both without stretching, is the ground's, whose records they keep.
    for demand, stretch in ((Peaks(pga_g=0.37), True), (BOTH, False)):
        shaking = Suite(motions=led).at(demand, stretch=stretch)
        own = measured(SUITE)
        np.testing.assert_allclose(shaking.scales, 0.37 / own[:, 0], rtol=1e-9)
        np.testing.assert_allclose(
            shaking.floor_pga_g,
            [0.37 / a * peaks_of(each)[0] for a, each in zip(own[:, 0], led, strict=True)],
            rtol=1e-9,
        )


def test_a_demand_is_read_as_people_write_it() -> None:
    assert BOTH.words == "0.37 g and 0.44 m/s"
    assert Peaks(pgv_m_s=0.44).words == "0.44 m/s"
    assert Peaks(pga_g=0.37).words == "0.37 g"


def test_folds_are_of_factors_up_and_down() -> None:
    factors = np.array([0.1, 0.5, 1.0, 4.0])
    assert folds(factors).tolist() == [10.0, 2.0, 1.0, 4.0]
    assert median_fold(factors) == 3.0
    assert median_fold(1.0 / factors) == pytest.approx(3.0)
    assert math.isclose(median_fold(np.array([0.25])), 4.0)


def test_copies_differ_by_sign_and_scale_alone() -> None:
    first, second, *_ = SUITE
    lifted = BaseMotion(first, second)
    others: list[Motion] = [
        first.scaled(0.3),
        first.reversed(),
        replace(first, name="again"),
        BaseMotion(first.scaled(-2.0), second.scaled(2.0)),
    ]
    kept = distinct([first, second, lifted, *others])
    assert [id(each) for each in kept] == [id(each) for each in (first, second, lifted)]
    # Another step, another vertical component or its other sign is another motion.
    altered: list[Motion] = [
        replace(first, dt_s=2.0 * first.dt_s),
        BaseMotion(first, second.scaled(0.5)),
        BaseMotion(first, second.reversed()),
    ]
    assert len(distinct([first, lifted, *altered])) == 5
