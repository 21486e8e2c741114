"""ASCE 43-05: the worked value, and that no root of any spectrum is missed."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from rocksteady import Block
from rocksteady.risk.screens._asce import RockingBody, find_rotations, rotations_text
from rocksteady.risk.spectra.tabulated import Chain

G = 9.80665


def body(slope: float = 0.25, height: float = 1.0) -> RockingBody:
    return RockingBody(math.atan(slope), height, 4.0 / 3.0 * (1.0 + slope**2), G)


def test_the_worked_value() -> None:
    case = body()
    assert case.frequency_hz(0.1) == pytest.approx(0.836699, abs=5e-7)
    assert case.restitution == pytest.approx(0.9117647, abs=5e-8)
    assert case.damping == pytest.approx(0.0293906, abs=5e-8)
    assert case.capacity_m_s2(0.1) / G == pytest.approx(0.3992504, abs=5e-8)


def test_a_block_gives_the_same_body_with_housners_restitution() -> None:
    block = Block.rectangle(width=0.5, height=2.0)
    found = RockingBody.of_side(block.positive, G, 0.0)
    assert found.inertia == pytest.approx(4.0 / 3.0 * (1.0 + 0.25**2), rel=1e-14)
    assert found.height_m == pytest.approx(1.0)
    assert found.restitution == pytest.approx(block.restitution, rel=1e-13)
    assert found.frequency_hz(0.1) == pytest.approx(body().frequency_hz(0.1), rel=1e-13)


@given(st.floats(0.05, 0.9), st.floats(0.01, 0.999))
def test_rise_and_elasticity_are_those_of_f1(slope: float, part: float) -> None:
    case = body(slope)
    t = part * case.alpha

    def rise(angle: float) -> float:
        return math.cos(angle) + slope * math.sin(angle) - 1.0

    assert case.rise(t) == pytest.approx(rise(t), abs=1e-14)
    step = 1e-5 * t
    derivative = (rise(t + step) - rise(t - step)) / (2.0 * step)
    assert case.elasticity(t) == pytest.approx(t * derivative / rise(t), abs=1e-6)


@given(st.floats(0.05, 0.9))
def test_period_rises_capacity_and_elasticity_fall(slope: float) -> None:
    case = body(slope)
    at = [part * case.alpha for part in np.linspace(1e-6, 1.0 - 1e-9, 300)]
    frequencies, capacities, elasticities = (
        [function(t) for t in at]
        for function in (case.frequency_hz, case.capacity_m_s2, case.elasticity)
    )
    for values in (frequencies, capacities, elasticities):
        assert values == sorted(set(values), reverse=True)
    assert 0.0 < elasticities[-1] < elasticities[0] <= 1.0


spectra = st.lists(st.floats(-2.5, 1.0), min_size=2, max_size=9)


@given(st.floats(0.05, 0.8), st.floats(0.1, 4.0), spectra)
def test_every_crossing_of_a_dense_scan_is_found_and_every_root_is_one(
    slope: float, height: float, logs: list[float]
) -> None:
    case = body(slope, height)
    longest = 1.3 / case.frequency_hz(case.alpha)
    periods = np.geomspace(0.02, longest, len(logs)) * (1.0 + 0.1 * np.sin(np.arange(len(logs))))
    values = 2.0 * slope * G * np.exp(np.array(logs))
    chain = Chain(tuple(np.sort(periods).tolist()), tuple(values.tolist()))
    found = find_rotations(case, chain)

    def distance(t: float) -> float:
        return math.log(case.capacity_m_s2(t) / chain.at(1.0 / case.frequency_hz(t)))

    top = found.examined_rad
    scan = np.concatenate([np.geomspace(1e-8 * case.alpha, top, 400), np.linspace(0, top, 402)[1:]])
    scan = np.unique(np.clip(scan, 0.0, top))
    signs = np.sign([distance(t) for t in scan.tolist()])
    for root in found.roots_rad:
        assert 0.0 < root <= case.alpha
        assert distance(root) == pytest.approx(0.0, abs=1e-7)
    roots = np.array(found.roots_rad)
    assert (np.diff(roots) > 0.0).all()
    for low, high, before, after in zip(scan, scan[1:], signs, signs[1:], strict=False):
        inside = ((roots > low) & (roots <= high)).sum()
        if before * after < 0.0:
            assert inside % 2 == 1, (low, high)
        elif before * after > 0.0:
            assert inside % 2 == 0, (low, high)


def test_two_roots_between_neighbours_of_a_coarse_scan_are_both_found() -> None:
    """A demand of T^-1/2 meets the capacity twice; it is raised until the two roots touch."""
    case = body()
    longest = 1.1 / case.frequency_hz(case.alpha)

    def roots(level: float) -> tuple[float, ...]:
        values = tuple(level * G * t**-0.5 for t in (1e-4, longest))
        return find_rotations(case, Chain((1e-4, longest), values)).roots_rad

    low, high = 0.05, 2.0
    for _ in range(36):  # the level at which the two roots of the middle merge
        middle = 0.5 * (low + high)
        low, high = (middle, high) if roots(middle) else (low, middle)
    nearly = roots(low)
    assert len(nearly) == 2
    assert 0.0 < nearly[1] - nearly[0] < 1e-4 * case.alpha


def test_roots_that_are_known_are_found_again() -> None:
    """A spectrum through the capacity at three rotations has roots there."""
    case = body(0.3, 2.0)
    chosen = [0.03, 0.1, 0.2]
    points = [(1.0 / case.frequency_hz(t), case.capacity_m_s2(t)) for t in chosen]
    periods = (0.5 * points[0][0], *(period for period, _ in points), 20.0)
    values = (0.3 * points[0][1], *(value for _, value in points), 30.0)
    found = find_rotations(case, Chain(periods, values))
    for t in chosen:
        assert min(abs(root - t) for root in found.roots_rad) < 1e-9
    assert found.examined_rad == case.alpha
    assert found.above_at_end


def test_a_short_spectrum_is_examined_to_its_end() -> None:
    case = body()
    period = 1.0 / case.frequency_hz(0.1)
    found = find_rotations(case, Chain((0.1, period), (9.0, 9.0)))
    assert found.examined_rad == pytest.approx(0.1)


def test_three_angles_are_listed_and_four_are_counted() -> None:
    assert rotations_text((0.1,)) == "0.1 rad"
    assert rotations_text((0.02, 0.05, 0.1)) == "0.02 and 0.05 and 0.1 rad"
    assert rotations_text((0.01, 0.02, 0.05, 0.1)) == "4 angles from 0.01 to 0.1 rad"
