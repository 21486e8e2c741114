"""Intensity measures: closed forms of sines, scaling, and what a block makes of them."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.optimize import brentq

from rocksteady import Block, DimensionlessBlock, Record, Status, compute_measures, simulate
from rocksteady.errors import InputError
from rocksteady.measures import compute_response_spectrum
from rocksteady.model.equations import Nonlinear
from rocksteady.seismic.measures.intensity import _simpson
from rocksteady.words.records import WORDS
from tests.every import every
from tests.seismic.sines import noise, sine

BLOCK = Block.rectangle(width=0.4, height=1.6, gravity=3.7)


def test_a_period_of_a_sine() -> None:
    found = compute_measures(sine())
    assert found.pga_m_s2 == pytest.approx(2.0)
    assert found.pga_g == pytest.approx(2.0 / 9.80665)
    assert found.pgv_per_pga_s == pytest.approx(1.0 / math.pi, rel=1e-6)
    assert found.pgd_m == pytest.approx(1.0 / math.pi, rel=1e-6)
    assert found.cav_m_s == pytest.approx(4.0 / math.pi, rel=1e-6)
    assert found.arias_m_s == pytest.approx(math.pi / 9.80665, rel=1e-6)
    # Over whole swings the trapezoidal rule is exact for a sine.
    assert found.arias_of_samples_m_s == pytest.approx(math.pi / 9.80665, rel=1e-12)
    assert found.arias_of_samples_m_s > found.arias_m_s
    # The part of the intensity at t is t - sin(4 pi t)/(4 pi), which is symmetric about 1/2.
    begin = brentq(lambda t: t - math.sin(4.0 * math.pi * t) / (4.0 * math.pi) - 0.05, 0.0, 0.5)
    strong = found.significant_5_95_s
    assert strong == pytest.approx(1.0 - 2.0 * begin, rel=1e-6)
    assert found.rms_m_s2 == pytest.approx(math.sqrt(0.9 * 2.0 / strong), rel=1e-6)
    assert not found.drifts


def test_the_mean_period_of_a_long_sine_is_its_period() -> None:
    # Without its last sample, so that the transform sees whole cycles and nothing leaks.
    samples = sine(20_001, cycles=100.0).acceleration_m_s2[:-1]
    record = Record(acceleration_m_s2=samples, dt_s=0.005)
    assert compute_measures(record).mean_period_s == pytest.approx(1.0, rel=1e-9)


def test_the_mean_period_is_the_sum_over_frequencies() -> None:
    record = noise(5, samples=300)
    count = 1000  # 20 s of samples every 0.02 s: 0.05 Hz apart
    a = np.concatenate([record.acceleration_m_s2, np.zeros(count - 300)])
    time, above, below = np.arange(count) * 0.02, 0.0, 0.0
    for k in range(1, 500):
        f = k * 0.05
        if 0.25 - 1e-9 <= f <= 20.0 + 1e-9:
            c2 = abs(np.sum(a * np.exp(-2j * np.pi * f * time))) ** 2
            above, below = above + c2 / f, below + c2
    assert compute_measures(record).mean_period_s == pytest.approx(above / below, rel=1e-9)


def test_a_record_without_those_frequencies_has_no_mean_period() -> None:
    slow = Record(acceleration_m_s2=np.array([0.0, 1.0, 0.0]), dt_s=10.0)
    assert math.isnan(compute_measures(slow).mean_period_s)


def test_a_push_that_grows_leaves_its_velocity_and_its_way() -> None:
    found = compute_measures(Record(acceleration_m_s2=np.linspace(0.0, 2.0, 5), dt_s=0.25))
    # The acceleration is 2 t, up to t = 1.
    assert found.final_velocity_m_s == pytest.approx(1.0, rel=1e-14)
    assert (found.pgv_m_s, found.pgd_m) == pytest.approx((1.0, 1.0 / 3.0), rel=1e-14)


def test_simpsons_rule_is_exact_for_cubics() -> None:
    at = np.linspace(-1.0, 2.0, 7)
    assert _simpson(at**3 - 2.0 * at + 1.0, at) == pytest.approx(15.0 / 4.0 - 3.0 + 3.0, rel=1e-14)


def test_housners_intensity_is_the_area_below_the_pseudo_velocity() -> None:
    record = noise(6, samples=400)
    periods = np.linspace(0.1, 2.5, 2001)
    fine = compute_response_spectrum(record, periods[::20]).pseudo_velocity_m_s
    area = float(np.trapezoid(fine, periods[::20]))
    assert compute_measures(record).housner_intensity_m == pytest.approx(area, rel=5e-3)


@pytest.mark.slow
@settings(max_examples=10)
@given(st.integers(0, 1000), st.floats(0.1, 10.0))
def test_how_the_measures_grow_with_the_record(seed: int, factor: float) -> None:
    one, other = (
        compute_measures(noise(seed).scaled(scale), BLOCK, threshold_m_s2=0.5 * abs(scale))
        for scale in (1.0, -factor)
    )
    grows = {
        **dict.fromkeys(("arias_m_s", "arias_of_samples_m_s"), 2),
        **dict.fromkeys(("pga_m_s2", "pga_g", "pgv_m_s", "pgd_m", "cav_m_s", "rms_m_s2"), 1),
        **dict.fromkeys(("housner_intensity_m", "pga_per_uplift", "p_pgv_per_uplift"), 1),
    }
    for name in WORDS:
        if name in ("final_velocity_m_s", "threshold_m_s2", "damping", "drifts"):
            continue
        expected = getattr(one, name) * factor ** grows.get(name, 0)
        assert getattr(other, name) == pytest.approx(expected, rel=1e-9), name


def test_what_a_block_makes_of_them() -> None:
    record = noise(7)
    found = compute_measures(record, BLOCK)
    uplift = BLOCK.gravity * 0.4 / 1.6
    assert found.pga_per_uplift == pytest.approx(found.pga_m_s2 / uplift)
    assert found.p_pgv_per_uplift == pytest.approx(BLOCK.p * found.pgv_m_s / uplift)
    assert found.p_pgv_per_pga == pytest.approx(BLOCK.p * found.pgv_per_pga_s)
    assert compute_measures(record).pga_per_uplift is None


@pytest.mark.parametrize("part", [0.999, 1.001])
def test_a_block_lifts_where_the_first_of_them_passes_1(part: float) -> None:
    record = noise(8)
    size = part / (compute_measures(record, BLOCK).pga_per_uplift or 1.0)
    run = simulate(BLOCK, record.scaled(size), model=Nonlinear())
    assert run.status is Status.AT_REST
    assert (run.peak > 0.0) is (part > 1.0)


def test_of_an_asymmetric_block_the_side_counts_that_lifts_first() -> None:
    block = Block.asymmetric(left=0.25, right=0.15, height=1.2)
    found = compute_measures(noise(7), block)
    expected = found.pga_m_s2 / (block.gravity * math.tan(block.negative.alpha))
    assert found.pga_per_uplift == pytest.approx(expected)


@every("sign", [1.0, -1.0])
@every("wall", [True, False])
def test_what_is_said_to_lift_a_block_does(sign: float, wall: bool) -> None:
    ramp = np.array([0.0, 2.6, 5.2, 2.6, -0.5, 0.0])
    record = Record(acceleration_m_s2=sign * ramp, dt_s=0.1, name="push")
    block = Block.asymmetric(left=0.15, right=0.4, height=1.2)
    block = block.against_wall(0.5) if wall else block
    measures = compute_measures(record, block)
    lifts = simulate(block, record).peak > 0.0
    assert lifts is (measures.peak_per_uplift > 1.0)  # type: ignore[operator]
    answer = measures.describe()
    assert ("never lifts" in str(answer.screen[0])) is not lifts


def test_what_is_refused() -> None:
    with pytest.raises(InputError, match=r"^block = "):
        compute_measures(sine(), DimensionlessBlock(restitution=0.9))  # type: ignore[arg-type]
    with pytest.raises(InputError, match=r"^threshold_m_s2 = "):
        compute_measures(sine(), threshold_m_s2=0.0)
    for factor in (1e30, 1e-30):
        with pytest.raises(InputError, match=r"^acceleration_m_s2 = "):
            compute_measures(sine().scaled(factor).scaled(factor))
