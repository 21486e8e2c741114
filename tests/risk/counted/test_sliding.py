"""Friction under the motions of a suite: Shenton's formula at their peaks, and levels scanned."""

import math

import numpy as np
import pytest

from rocksteady import Block, Record
from rocksteady.errors import ModelError
from rocksteady.motions import Floor, make_synthetic_suite
from rocksteady.risk import Levels
from rocksteady.risk.counted.sliding import friction_at, sliding_level
from rocksteady.risk.screens.friction import needed_friction
from tests.every import every
from tests.risk.counted.recorded import RACKS, G

SUITE = make_synthetic_suite(5, seed=4)
BLOCK = Block.rectangle(width=0.4, height=1.6)
SLOPE = 0.25


def shenton(pga_g: float, slope: float = SLOPE) -> float:
    """Return the friction of a rectangle: Shenton (1996), once it lifts; below, its peak."""
    if pga_g <= slope:
        return pga_g
    return (pga_g * (1.0 + 4.0 * slope**2) + 3.0 * slope) / (4.0 + slope**2 + 3.0 * slope * pga_g)


def scanned(levels: np.ndarray, worst: float, friction: float) -> float:
    """Return the first level of a fine scan at which rocking needs more."""
    needs = [shenton(level * worst) for level in levels]
    return float(levels[next(k for k, need in enumerate(needs) if need > friction)])


def at_one(measure: str, motions: list[Record], *blocks: Block) -> np.ndarray:
    return Levels(measure).at_scale_one(motions, list(blocks) or [BLOCK])


@every("friction", [0.2501, 0.3, 0.5, 1.0])
@every("measure", ["pga_g", "pgv_m_s"])
def test_it_slides_above_the_level_that_a_scan_finds(measure: str, friction: float) -> None:
    motions = [*SUITE]
    ones = at_one(measure, motions)
    peaks = [each.peak_acceleration_m_s2 / G for each in motions]
    worst = max(peak / one for peak, one in zip(peaks, ones[0], strict=True))
    found = sliding_level([BLOCK], motions, ones, friction)
    step = 1e-4 * found
    levels = np.arange(0.5 * SLOPE / worst, 1.5 * found, step)
    first = scanned(levels, worst, friction)
    assert first - step <= found <= first
    if measure == "pga_g":
        assert worst == pytest.approx(1.0, rel=1e-12)


def test_on_a_floor_the_peak_is_the_floors_and_the_level_the_grounds() -> None:
    floor = Floor(**RACKS)
    motions = [floor.motion(each) for each in SUITE]
    grown = max(
        led.peak_acceleration_m_s2 / each.peak_acceleration_m_s2
        for led, each in zip(motions, SUITE, strict=True)
    )
    ones = at_one("pga_g", motions)
    (ground,) = {sliding_level([BLOCK], [*SUITE], at_one("pga_g", [*SUITE]), 0.4)}
    assert sliding_level([BLOCK], motions, ones, 0.4) == pytest.approx(ground / grown, rel=1e-9)
    assert grown > 1.0


def test_the_first_of_several_blocks_to_slide_decides() -> None:
    wide = Block.rectangle(width=0.5, height=1.6)
    motions = [*SUITE]
    alone = [sliding_level([b], motions, at_one("pga_g", motions, b), 0.4) for b in (BLOCK, wide)]
    for both in ([BLOCK, wide], [wide, BLOCK]):
        assert sliding_level(both, motions, at_one("pga_g", motions, *both), 0.4) == min(alone)
    assert alone[0] != alone[1]


def test_there_is_a_friction_with_which_it_never_slides() -> None:
    """The limit of Shenton's expression, (1 + 4 a^2)/(3 a): 1.67 of a = 1/4."""
    limit = (1.0 + 4.0 * SLOPE**2) / (3.0 * SLOPE)
    motions = [*SUITE]
    ones = at_one("pga_g", motions)
    assert sliding_level([BLOCK], motions, ones, 1.0001 * limit) == math.inf
    assert 1e3 < sliding_level([BLOCK], motions, ones, 0.9999 * limit) < math.inf


def test_what_slides_before_it_lifts_is_refused_with_the_friction_that_rocking_takes() -> None:
    motions = [*SUITE]
    with pytest.raises(
        ModelError, match=r"friction = 0\.2 .*slides before it lifts.* 0\.25 or mor"
    ):
        sliding_level([BLOCK], motions, at_one("pga_g", motions), 0.2)
    aside = Block.asymmetric(left=0.2, right=0.3, height=1.6)
    level = 1.0001 * 0.25  # at which it lifts to the left
    need = needed_friction(aside, level).largest
    assert need > 1.04 * level
    with pytest.raises(ModelError, match="slides before it lifts"):
        sliding_level([aside], motions, at_one("pga_g", motions, aside), 0.5 * (level + need))


def test_the_worst_block_under_the_worst_peak_needs_most() -> None:
    wide = Block.rectangle(width=0.6, height=1.6)
    peaks = np.array([0.1, 0.5, 0.45])
    both = friction_at([BLOCK, wide], peaks)
    needs = [shenton(0.5), shenton(0.5, 0.375)]
    assert both.largest == pytest.approx(max(needs), rel=1e-12)
    assert friction_at([BLOCK], peaks).largest == pytest.approx(shenton(0.5), rel=1e-12)
    assert friction_at([BLOCK], 0.2 * peaks).largest == pytest.approx(0.1)  # below uplift: its peak
    # A base that falls at .2 g takes a fifth of gravity away.
    lifted = friction_at([BLOCK], peaks, 0.2)
    assert lifted.largest == pytest.approx(shenton(0.5 / 0.8), rel=1e-12)
