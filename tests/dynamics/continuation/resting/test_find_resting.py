"""Orbits with rest over a parameter, against bounces in 80 digits, sweeps and scaling laws."""

import math

import numpy as np
import pytest
from mpmath import mp, mpf

from rocksteady import (
    Block,
    DimensionlessBlock,
    Harmonic,
    Linear,
    Nonlinear,
    find_attractor,
    find_orbits,
)
from rocksteady.branches import NoRest, find_resting_branches, follow_resting_branch
from rocksteady.dynamics.continuation.resting.resting_branch import RestingBranch
from rocksteady.errors import InputError, ModelError
from rocksteady.model.equations import Model
from rocksteady.orbits import sweep_attractor
from tests.dynamics.continuation.resting.bounces import way_from_uplift

BLOCK = DimensionlessBlock(restitution=0.8)
SLENDER = Block.from_p(alpha=0.25, p=2.0, restitution=0.8)


def first_branch(
    block: Block | DimensionlessBlock,
    parameter: str,
    within: tuple[float, float],
    *,
    amplitude: float = 1.05,
    frequency: float = 2.0,
    model: Model | None = None,
) -> RestingBranch:
    motion = Harmonic(amplitude=amplitude, frequency_ratio=frequency)
    step = (within[1] - within[0]) / 8.0
    found = find_resting_branches(block, motion, parameter, within, resolution=step, model=model)
    return found.branches[0]


@pytest.mark.slow
@pytest.mark.parametrize(
    ("parameter", "within"), [("amplitude", (1.03, 1.08)), ("restitution", (0.85, 0.9))]
)
def test_rest_ends_where_bounces_in_80_digits_reach_the_next_uplift(
    parameter: str, within: tuple[float, float]
) -> None:
    branch = first_branch(BLOCK, parameter, within)
    assert branch.end.type == "end-of-rest"
    point = branch.end
    rests = []
    for shift in (-1e-12, 1e-12):
        here = {"amplitude": mpf(point.amplitude), "restitution": mpf(point.restitution)}
        here[parameter] += mpf(shift)
        rests.append(way_from_uplift(here["amplitude"], 2, here["restitution"]).rests)
    assert rests == [True, False]


def test_bounces_die_out_when_they_do_in_80_digits() -> None:
    point = first_branch(BLOCK, "amplitude", (1.03, 1.06)).at(1.05)
    way = way_from_uplift(1.05, 2, mpf(0.8))
    (here, _) = point.excursions
    assert way.rests
    assert float(abs(way.end - mpf(here.chatter_end))) <= max(1e-13, 10.0 * here.chatter_error)
    assert here.rest == pytest.approx(float(way.until - way.end), abs=1e-12)
    known = [float(phase) for phase in way.phases[: len(here.impacts)]]
    assert here.impact_phases == pytest.approx(known, abs=1e-13)


def test_near_uplift_the_peak_grows_with_the_square_of_the_excess() -> None:
    branch = first_branch(BLOCK, "amplitude", (0.99, 1.07))
    assert branch.begin.type == "uplift"
    assert branch.within[0] == math.nextafter(1.0, 2.0)
    # Departures from the leading term are of the order of the root of the excess.
    for excess, near in ((1e-4, 2e-2), (1e-6, 2e-3), (1e-8, 2e-4)):
        point = branch.at(1.0 + excess)
        law = 4.5 * (point.amplitude - 1.0) ** 2 / 4.0
        assert point.highest == pytest.approx(law, rel=near)


def test_near_uplift_the_nonlinear_peak_has_the_same_law() -> None:
    branch = first_branch(SLENDER, "amplitude", (1.0, 1.05), model=Nonlinear())
    least = math.tan(0.25) / 0.25
    assert branch.within[0] == pytest.approx(least, rel=1e-15)
    point = branch.at(least + 1e-6)
    excess = point.amplitude - least
    law = math.cos(0.25) * 4.5 * excess**2 / (least * 4.0)
    assert point.highest == pytest.approx(law, rel=2e-3)


@pytest.mark.slow
@pytest.mark.parametrize("restitution", [0.5, 0.8])
def test_rest_vanishes_with_the_power_that_the_border_has(restitution: float) -> None:
    block = DimensionlessBlock(restitution=restitution)
    branch = first_branch(block, "amplitude", (1.03, 1.2))
    r = float(
        mp.findroot(
            lambda x: (3 - x) * (1 - x) ** 2 - restitution**2 * (3 - 2 * x),
            (0.01, 0.9),
            solver="anderson",
        )
    )
    growth = (3 - r) ** 2 / ((1 - r) * (3 - 2 * r) ** 2)
    power = -math.log(1 - r) / math.log(growth)
    # One pair of impacts divides the distance by `growth`; whole numbers of them cancel the ripple.
    end = branch.within[1]
    many = round(math.log(1e4) / math.log(growth))
    far, near = (branch.at(end - d).rests[0] for d in (1e-5, 1e-5 * growth**-many))
    assert math.log(far / near) / (many * math.log(growth)) == pytest.approx(power, abs=2e-3)


@pytest.mark.parametrize(("block", "model"), [(BLOCK, Linear()), (SLENDER, Nonlinear())])
def test_sweeps_lie_on_the_branch(block: Block | DimensionlessBlock, model: Model) -> None:
    branch = first_branch(block, "amplitude", (1.03, 1.07), model=model)
    hidden = np.array([1.0331, 1.0419, 1.0587, 1.0666])
    motion = Harmonic(amplitude=1.0, frequency_ratio=2.0)
    sweep = sweep_attractor(block, motion, "amplitude", hidden, model=model)
    for value, attractor, peaks in zip(hidden, sweep.attractors, sweep.peaks, strict=True):
        point, orbit = branch.at(value), attractor.orbit
        assert orbit is not None
        assert (point.period, point.rest_phases) == (orbit.period, orbit.rest_phases)
        assert point.highest == pytest.approx(orbit.highest, rel=1e-10)
        assert np.sort(point.peaks) == pytest.approx(np.sort(peaks), abs=1e-14)
        assert point.orbit.highest == orbit.highest


def test_of_an_asymmetric_block_the_mirror_image_has_the_mirrored_branches() -> None:
    ratio = 1.05
    motion = Harmonic(amplitude=1.0, frequency_ratio=2.0)
    here = find_resting_branches(
        DimensionlessBlock(restitution=0.8, alpha_ratio=ratio),
        motion,
        "amplitude",
        (0.98, 1.07),
        resolution=0.01,
    )
    there = find_resting_branches(
        DimensionlessBlock(restitution=0.8, alpha_ratio=1 / ratio),
        motion,
        "amplitude",
        (0.98 / ratio, 1.07 / ratio),
        resolution=0.01 / ratio,
    )
    assert len(here.branches) == len(there.branches) == 2
    for one, other in zip(here.branches, there.branches, strict=True):
        assert [p.type for p in (one.begin, one.end)] == [p.type for p in (other.begin, other.end)]
        assert np.array(one.within) == pytest.approx(np.array(other.within) * ratio, rel=1e-12)
        middle = 0.5 * sum(one.within)
        a, b = one.at(middle), other.at(middle / ratio)
        assert (a.highest, a.lowest) == pytest.approx((-b.lowest * ratio, -b.highest * ratio))
    # The flatter side lifts first; where the other joins, its flights begin at 0.
    first, second = here.branches
    assert first.end.type == second.begin.type == "uplift"
    assert second.within[0] == pytest.approx(ratio, rel=1e-15)
    assert first.end.highest == pytest.approx(second.begin.highest, rel=1e-9)


@pytest.mark.parametrize("restitution", [0.0, 0.5])
def test_against_a_wall_every_rest_ends_in_an_uplift_to_the_free_side(restitution: float) -> None:
    wall = DimensionlessBlock(restitution=restitution, one_sided=True)
    branch = first_branch(wall, "amplitude", (0.9, 1.3), amplitude=1.0)
    assert (branch.begin.type, branch.rest_phases, branch.symmetric) == ("uplift", 1, False)
    point = branch.at(1.1)
    attractor = find_attractor(wall, Harmonic(amplitude=1.1, frequency_ratio=2.0))
    assert attractor.orbit is not None
    assert point.highest == pytest.approx(attractor.orbit.highest, rel=1e-12)
    assert point.lowest == 0.0


def test_gaps_say_why() -> None:
    motion = Harmonic(amplitude=1.0, frequency_ratio=2.0)
    found = find_resting_branches(BLOCK, motion, "amplitude", (0.5, 3.0), resolution=0.1)
    assert found.gaps[0].reasons == (NoRest.BELOW_UPLIFT,)
    assert found.gaps[0].high == pytest.approx(1.0, abs=1e-15)
    assert NoRest.OVERTURNS in found.gaps[-1].reasons
    ends = [branch.within for branch in found.branches] + [(g.low, g.high) for g in found.gaps]
    covered = sum(high - low for low, high in ends)
    assert covered == pytest.approx(2.5, abs=1e-12)
    # Without loss a block never comes to rest.
    lossless = find_resting_branches(
        DimensionlessBlock(restitution=1.0), motion, "amplitude", (1.01, 1.1), resolution=0.05
    )
    assert not lossless.branches
    assert len(lossless.gaps) == 1


@pytest.mark.slow
def test_where_rounding_decides_a_branch_ends_before_other_uplifts() -> None:
    block = DimensionlessBlock(restitution=0.8, alpha_ratio=1.05)
    motion = Harmonic(amplitude=1.0, frequency_ratio=2.0)
    within = (1.1055, 1.1057)
    result = find_resting_branches(block, motion, "amplitude", within, resolution=2e-4)
    ways = [
        {tuple((leg.side, leg.half_cycles) for leg in point.legs) for point in branch.points}
        for branch in result.branches
    ]
    assert ways == [{((1, 4),)}, {((1, 3), (-1, 1))}, {((1, 4),)}]
    assert result.branches[1].begin.type == result.branches[1].end.type == "undecided"


def test_an_orbit_is_followed_to_both_ends_of_its_branch() -> None:
    motion = Harmonic(amplitude=1.04, frequency_ratio=2.0)
    (orbit,) = (o for o in find_orbits(BLOCK, motion, max_period=1, seeds=2) if o.rest_phases)
    branch = follow_resting_branch(orbit, "amplitude", (0.9, 1.1))
    other = first_branch(BLOCK, "amplitude", (0.99, 1.078))
    assert branch.within == other.within
    assert branch.at(1.04).orbit.states == orbit.states


def test_what_cannot_be_is_refused() -> None:
    motion = Harmonic(amplitude=2.0, frequency_ratio=2.0)
    moving = find_orbits(BLOCK, motion, max_period=1, seeds=2)[0]
    with pytest.raises(ModelError, match="never comes to rest"):
        follow_resting_branch(moving, "amplitude", (1.0, 3.0))
    with pytest.raises(InputError, match="amplitude, frequency_ratio, restitution"):
        find_resting_branches(BLOCK, motion, "phase", (0.0, 1.0))
    with pytest.raises(InputError, match="lower end"):
        find_resting_branches(BLOCK, motion, "amplitude", (2.0, 1.0))
    with pytest.raises(InputError, match="of the range"):
        find_resting_branches(BLOCK, motion, "amplitude", (1.0, 2.0), resolution=1e-9)
    with pytest.raises(InputError, match="the branch goes from"):
        first_branch(BLOCK, "amplitude", (1.03, 1.07)).at(1.2)


def test_at_a_graze_impacts_vanish_and_the_motion_is_continuous() -> None:
    block = DimensionlessBlock(restitution=0.3)
    branch = first_branch(block, "amplitude", (1.1935, 1.1955), frequency=5.4)
    (graze,) = (point for point in branch.points if point.type == "grazing")
    assert graze.gains == -1
    assert graze.touch is not None
    place, first = graze.amplitude, graze.touch[1]
    # In 80 digits the touch is there below, and above the flight goes on.
    below, above = (
        way_from_uplift(mpf(place) + mpf(d), 5.4, mpf(0.3), half_cycles=3, impacts=first).phases[-1]
        for d in (-1e-10, 1e-10)
    )
    known = graze.excursions[0].impact_phases
    assert float(below) == pytest.approx(known[first - 1], abs=1e-3)
    assert float(above) == pytest.approx(known[first + 1], abs=1e-3)
    assert above - below > 0.01
    # With the impacts the end of the bounces departs like a square root, without them linearly.
    end = graze.excursions[0].chatter_end

    def moved(shift: float) -> float:
        return abs(branch.at(place + shift).excursions[0].chatter_end - end)

    assert moved(-1e-8) / moved(-1e-10) == pytest.approx(10.0, rel=0.05)
    # The point lies some roundings from the graze: the root of 2e-15 is 5e-4 of that of 1e-8.
    a, b, c = (branch.at(place + k * 1e-6).excursions[0].chatter_end for k in (1, 2, 3))
    assert c - b == pytest.approx(b - a, rel=1e-3)
    assert a - (b - a) == pytest.approx(end, abs=5e-4 * moved(-1e-8))
