"""Demand of records: spectra that SciPy integrates, a dense search, and what is refused."""

import math
from itertools import pairwise

import numpy as np
import pytest
from scipy.signal import lsim

from rocksteady import Record
from rocksteady.codes import RecordDemand
from rocksteady.errors import InputError
from rocksteady.facades.checks.record_demand import _largest, different_motions
from rocksteady.measures import compute_response_spectrum
from rocksteady.seismic.spectra.batch import GroundShaking
from tests.every import every
from tests.facades.checks.suites import motion, motions

G = 9.80665
DEMAND = RecordDemand(records=tuple(motions(7, 0.3 * G)))


def swing(record: Record, period_s: float, damping: float) -> float:
    """Return the largest displacement of an oscillator [m] at four instants of each interval."""
    w = 2.0 * math.pi / period_s
    step = 0.25 * record.dt_s
    t = step * np.arange(round((record.duration_s + 2.0 * period_s) / step))
    samples = record.dt_s * np.arange(len(record.acceleration_m_s2))
    push = np.interp(t, samples, record.acceleration_m_s2, right=0.0)
    _, u, _ = lsim(([-1.0], [1.0, 2.0 * damping * w, w * w]), push, t)
    return float(np.abs(u).max())


@pytest.mark.slow
@pytest.mark.parametrize("damping", [0.08, 0.10])
def test_the_demand_is_the_mean_of_the_largest_ordinate_of_each_record(damping: float) -> None:
    end = 1.6
    found = DEMAND.displacements_m(end, damping)
    for place, record in enumerate(DEMAND.records[:3]):
        dense = max(swing(record, period, damping) for period in np.linspace(0.1, end, 31).tolist())
        assert dense <= found[place] * (1.0 + 2e-3)
        assert found[place] == pytest.approx(dense, rel=0.01)
    assert DEMAND.displacement_m(end, damping) == pytest.approx(math.fsum(found) / 7.0)


@pytest.mark.slow
def test_a_longer_range_demands_no_less_and_damping_no_more() -> None:
    ends = (0.4, 1.5, 3.0)
    demands = [DEMAND.displacements_m(end, 0.08) for end in ends]
    for shorter, longer in pairwise(demands):
        assert (longer >= shorter * (1.0 - 2e-3)).all()
    assert demands[-1].mean() > 2.0 * demands[0].mean()
    assert (DEMAND.displacements_m(1.5, 0.10) < demands[1]).all()


@pytest.mark.slow
def test_the_demand_is_proportional_to_the_records() -> None:
    twice = RecordDemand(records=tuple(each.scaled(2.0) for each in DEMAND.records))
    assert twice.displacement_m(1.2, 0.08) == pytest.approx(2.0 * DEMAND.displacement_m(1.2, 0.08))
    assert twice.sa_g(0.7, 0.05) == pytest.approx(2.0 * DEMAND.sa_g(0.7, 0.05))


def test_the_spectrum_begins_at_the_mean_peak_and_is_near_its_ordinates() -> None:
    assert DEMAND.sa_g(0.0, 0.05) == pytest.approx(0.3)
    w = 2.0 * math.pi / 0.9
    exact = np.mean([w * w * swing(record, 0.9, 0.08) / G for record in DEMAND.records])
    assert DEMAND.sa_g(0.9, 0.08) == pytest.approx(exact, rel=0.03)


@every("end", [0.02, 1.0])
def test_the_largest_ordinate_is_found_within_the_range(end: float) -> None:
    """Beside a dense search: a few sines, and a single one."""
    t = 0.02 * np.arange(100)
    sine = Record(acceleration_m_s2=np.sin(2.0 * np.pi * t / 0.21) * np.exp(-t), dt_s=0.02)
    for record in (motion(3, 3.0), sine):
        periods = np.linspace(end / 40.0, end, 40)
        dense = compute_response_spectrum(record, periods, damping=0.08).displacement_m
        found = _largest(record, end, 0.08)
        assert found == pytest.approx(float(dense.max()), rel=0.02)
        assert found <= float(dense.max()) * 1.02


def test_the_acceleration_is_exact_at_its_tabulated_periods_and_straight_between_them() -> None:
    edges = 0.05 * 160.0 ** (np.arange(30) / 29.0)
    own = RecordDemand(records=tuple(motions(7, 1.0)))
    values = np.mean(
        [
            compute_response_spectrum(record, edges[[0, 7, 8, -1]], damping=0.08)
            .pseudo_acceleration_m_s2
            for record in own.records
        ],
        axis=0,
    ) / G  # fmt: skip
    for place, period in enumerate(edges[[0, 7, 8]].tolist()):
        assert own.sa_g(period, 0.08) == pytest.approx(values[place], rel=1e-9)
    assert own.sa_g(8.0, 0.08) == pytest.approx(values[-1], rel=1e-9)
    half = own.sa_g(0.5 * float(edges[7] + edges[8]), 0.08)
    assert half == pytest.approx(0.5 * (values[1] + values[2]))
    assert own.sa_g(0.025, 0.08) == pytest.approx(0.5 * (own.sa_g(0.0, 0.08) + values[0]))
    with pytest.raises(InputError, match="period_s"):
        own.sa_g(8.001, 0.08)


def test_one_motion_is_known_by_its_samples_and_its_interval() -> None:
    first = motion(0, 1.0)
    slower = Record(acceleration_m_s2=first.acceleration_m_s2, dt_s=0.03)
    up = first.scaled(0.5)
    grounds = [
        GroundShaking(record=first),
        GroundShaking(record=slower),
        GroundShaking(record=first, vertical=up),
        GroundShaking(record=first, vertical=up.scaled(2.0)),
    ]
    assert different_motions(grounds) == 2
    nameless = Record(acceleration_m_s2=first.acceleration_m_s2, dt_s=0.03, name="")
    with pytest.raises(InputError, match="as record 2 and as record 5"):
        different_motions([*grounds, GroundShaking(record=nameless)])


def test_a_mean_needs_seven_records() -> None:
    with pytest.raises(InputError, match="7 or more"):
        RecordDemand(records=tuple(motions(6, 1.0)))


@every("period", [-0.1, math.nan, math.inf])
def test_a_period_is_a_number(period: float) -> None:
    for ask in (DEMAND.displacement_m, DEMAND.sa_g):
        with pytest.raises(InputError):
            ask(period, 0.08)


@every("damping", [-0.01, 1.0, 1.5, math.nan])
def test_damping_is_below_the_critical_one(damping: float) -> None:
    for ask in (DEMAND.displacement_m, DEMAND.sa_g):
        with pytest.raises(InputError, match="damping"):
            ask(1.0, damping)


def test_what_is_handed_out_is_a_copy() -> None:
    demand = RecordDemand(records=tuple(motion(seed, 1.0) for seed in range(7)))
    first = demand.displacements_m(1.0, 0.08)
    first[:] = 0.0
    assert demand.displacement_m(1.0, 0.08) > 0.0
