"""Built-in motions: seeded, with Brune's spectrum, at rest at their end, near real records."""

import itertools
import math
import random
from dataclasses import replace

import numpy as np
import pytest

from rocksteady import Record
from rocksteady.risk.counted.built_in import ACCURACY, make_built_in_suite
from rocksteady.risk.counted.motions import across
from rocksteady.risk.counted.suite import Peaks, Suite
from tests.risk.counted.recorded import Floats, G, described, judged, real_suite
from tests.risk.counted.test_suite import peaks_of


@pytest.fixture(scope="module", name="suite")
def _suite() -> Suite:
    return make_built_in_suite()


def records(suite: Suite) -> list[Record]:
    return [across(each) for each in suite.motions]


def noise(suite: Suite) -> list[Record]:
    """Return the motions before their time was stretched to the peaks that they are made with."""
    return [replace(each, dt_s=0.01) for each in records(suite)]


def test_they_are_the_same_each_time_whatever_was_drawn_before(suite: Suite) -> None:
    random.seed(5)
    np.random.seed(5)  # noqa: NPY002
    again = make_built_in_suite()
    assert len(records(suite)) == 59
    assert suite.built_in
    for one, other in zip(records(suite), records(again), strict=True):
        np.testing.assert_array_equal(one.acceleration_m_s2, other.acceleration_m_s2)
        assert one.name == other.name
    assert len({one.name for one in records(suite)}) == 59
    ends = {float(one.acceleration_m_s2[100]) for one in records(suite)}
    assert len(ends) == 59  # no two are alike


def test_they_have_both_peaks_of_a_demand(suite: Suite) -> None:
    demand = Peaks(pga_g=0.4, pgv_m_s=0.45)
    for each in suite.at(demand).motions:
        assert peaks_of(across(each)) == pytest.approx((0.4, 0.45), rel=1e-9)
    for each in records(suite):
        assert peaks_of(each) == pytest.approx((0.3, 0.4), rel=1e-9)


def test_the_ground_stands_still_at_the_end(suite: Suite) -> None:
    for each in records(suite):
        a = each.acceleration_m_s2
        velocity = np.cumsum(each.dt_s * a)
        assert abs(velocity[-1]) < 1e-7 * np.abs(velocity).max()
        assert np.abs(a[-20:]).max() < 0.1 * G
        assert abs(a[0]) < 1e-3 * G


def test_durations_are_those_of_strong_parts_of_15_to_90_s_and_the_corners_period(
    suite: Suite,
) -> None:
    durations = np.array([each.duration_s for each in noise(suite)])
    assert durations.min() > 1.6 * (15.0 + 1.0) - 0.1
    assert durations.max() < 1.6 * (90.0 + 1.0 / 0.15)
    # Evenly in its logarithm: a median near the root of both ends.
    assert np.median(durations) / 1.6 == pytest.approx(math.sqrt(15.0 * 90.0) + 2.5, rel=0.2)
    parts = []
    for each in records(suite):
        energy = np.cumsum(each.acceleration_m_s2**2)
        parts.append(np.searchsorted(energy, 0.5 * energy[-1]) / len(energy))
    # The envelope is largest after .1 to .35 of the strong part, 5/8 of the motion.
    assert 0.1 < float(np.mean(parts)) < 0.3
    assert max(parts) < 0.45


def amplitude(record: Record, hertz: float) -> float:
    """Return the root mean square of the Fourier amplitude about a frequency."""
    spectrum = np.abs(np.fft.rfft(record.acceleration_m_s2)) ** 2
    at = np.fft.rfftfreq(len(record.acceleration_m_s2), record.dt_s)
    near = (at > hertz / 1.3) & (at < hertz * 1.3)
    return math.sqrt(float(spectrum[near].mean()))


def brune(hertz: float, corner: Floats, kappa: Floats) -> Floats:
    """Return the logarithm of Brune's acceleration spectrum, high-passed at .08 Hz."""
    shape = hertz**2 / (1.0 + (hertz / corner) ** 2) / (1.0 + (0.08 / hertz) ** 4)
    return np.asarray(np.log(shape) - math.pi * kappa * hertz)


def test_the_spectrum_is_brunes_on_average_over_its_corners_and_decays(suite: Suite) -> None:
    """Of neighbouring octaves: up by 12 dB below the corner, flat above it, down by kappa."""
    corners, kappas = (
        each.ravel()
        for each in np.meshgrid(np.geomspace(0.15, 1.0, 201), np.linspace(0.02, 0.08, 51))
    )
    slopes = []
    for low, high in ((0.1, 0.2), (0.2, 0.4), (0.4, 0.8), (1.0, 2.0), (2.0, 4.0), (4.0, 8.0),
                      (8.0, 16.0)):  # fmt: skip
        found = [math.log(amplitude(each, high) / amplitude(each, low)) for each in noise(suite)]
        expected = brune(high, corners, kappas) - brune(low, corners, kappas)
        slopes.append(float(expected.mean()))
        assert float(np.mean(found)) == pytest.approx(slopes[-1], abs=0.15), (low, high)
    assert slopes[0] > 1.0  # f^2: towards ln 4
    assert slopes[-1] == pytest.approx(-0.05 * math.pi * 8.0, abs=0.01)


@pytest.mark.slow
def test_shares_are_as_near_to_those_of_real_records_as_is_said() -> None:
    """Of 6 objects at 4 demands each, both peaks matched."""
    differences = []
    sizes = ((0.15, 0.45), (0.3, 1.5), (0.32, 1.8), (0.6, 1.8), (0.6, 2.0), (1.0, 3.2))
    demands = ((0.55, 0.2), (0.8, 0.13), (0.8, 0.25), (1.1, 0.1))
    for (width, height), (ratio, period) in itertools.product(sizes, demands):
        slope, radius = width / height, 0.5 * math.hypot(width, height)
        velocity = ratio * G * slope / math.sqrt(0.75 * G / radius)
        one = described(width, height, pga_g=velocity / period / G, pgv_m_s=velocity)
        shares = []
        for motions in (None, real_suite()):
            found = judged(one, motions)
            shares.append(0.0 if found.count is None else found.count.share)
        differences.append(shares[0] - shares[1])
    rms, most = float(np.sqrt(np.mean(np.square(differences)))), float(np.max(np.abs(differences)))
    print(f"mean {np.mean(differences):.3f}, rms {rms:.3f}, largest {most:.3f}")  # noqa: T201
    usual, worst = ACCURACY
    assert rms <= usual
    assert most <= worst
