"""Quantities of a run: growth, uplift, friction, neighbours, and states to start from."""

import math
from itertools import product

import numpy as np
import pytest

from rocksteady import (
    BaseMotion,
    Block,
    DimensionlessBlock,
    Harmonic,
    Linear,
    Nonlinear,
    Piecewise,
    Pulse,
    Record,
    Rest,
    State,
    Status,
    Steady,
    Still,
    check_neighbours,
    floor_motion,
    simulate,
)
from rocksteady.errors import InputError, ModelError
from rocksteady.formulas import steady_states
from rocksteady.histories import Neighbours, Samples, Trajectory
from rocksteady.kernels.core import tables as columns_of
from rocksteady.kernels.march.forces import FORCES, FRICTION, fill_forces
from rocksteady.model.equations import Model
from rocksteady.model.linear_tables import mass_centres
from rocksteady.model.motions.segments import Motion
from rocksteady.motions import Segment
from rocksteady.risk.screens.friction import needed_friction
from tests.cli.motion_files import samples
from tests.descriptions import fits
from tests.every import every

BARE = DimensionlessBlock(restitution=0.8)
ASYMMETRY = DimensionlessBlock(restitution=0.8, alpha_ratio=1.4, p_ratio=0.9)
PIECES = (
    Segment(duration=1.0, constant=0.5),
    Segment(duration=0.7, constant=-1.2, slope=0.3),
    Segment(duration=2.0, amplitude=2.0, frequency=5.0),
)
STOCKY = Block.from_p(alpha=0.4, p=2.0, restitution=0.8)
SKEWED = Block.asymmetric(left=0.3, right=0.4, height=1.0, restitution=0.8)
UNEVEN = Block.asymmetric(left=0.2, right=0.8, height=1.0, restitution=0.8)
SHAKEN = Harmonic(amplitude=2.0, frequency_ratio=4.0, phase=0.3)
UP = Piecewise(pieces=(Segment(duration=3.0, constant=0.2, slope=-0.1),))
MOTIONS: dict[str, tuple[Block | DimensionlessBlock, Motion | BaseMotion, Model]] = {
    "harmonic": (BARE, SHAKEN, Linear()),
    "asymmetric": (ASYMMETRY, SHAKEN, Linear()),
    "piecewise": (BARE, Piecewise(pieces=PIECES), Linear()),
    "still": (BARE, Still(), Linear()),
    "full harmonic": (STOCKY, SHAKEN, Nonlinear()),
    "full asymmetric": (SKEWED, SHAKEN, Nonlinear()),
    "full, of unlike rates": (UNEVEN, SHAKEN, Nonlinear()),
    "full piecewise": (STOCKY, Piecewise(pieces=PIECES), Nonlinear()),
    "full vertical": (STOCKY, BaseMotion(Piecewise(pieces=PIECES), UP), Nonlinear()),
    "full still": (STOCKY, Still(), Nonlinear()),
}


def states(motions: Samples) -> np.ndarray:
    return np.array([motions.angle, motions.velocity])


@every("name", MOTIONS)
def test_growth_is_that_of_runs_that_begin_a_little_apart(name: str) -> None:
    block, motion, model = MOTIONS[name]
    start, h = (0.1, 0.2), 1e-8
    begun = State(angle=0.1, velocity=0.2)
    run = simulate(block, motion, start=begun, cycles=5.3, max_flights=12, model=model)
    at = run.impacts.pt + 1e-4
    assert len(at) >= 2
    columns = []
    for shift in ((h, 0.0), (0.0, h)):
        ends = [
            simulate(
                block,
                motion,
                start=State(angle=start[0] + sign * shift[0], velocity=start[1] + sign * shift[1]),
                cycles=5.3,
                model=model,
            )(at)
            for sign in (1.0, -1.0)
        ]
        columns.append((states(ends[0]) - states(ends[1])) / (2.0 * h))
    largest = np.sqrt((np.array(columns) ** 2).sum(axis=(0, 1))).max()
    assert run.growth == pytest.approx(largest, rel=5e-3)


def test_from_an_unstable_orbit_it_is_the_power_of_its_multiplier() -> None:
    point = steady_states(1.0, 2.0, 0.8)
    branch = next(b for b in (0, 1) if point.admissible[b] and not point.stable[b])  # type: ignore[index]
    trace = abs(float(point.trace[branch]))
    multiplier = 0.5 * (trace + math.sqrt(trace**2 - 4.0 * 0.8**2))
    motion = Harmonic(amplitude=1.0, frequency_ratio=2.0)
    start = Steady(branch=branch + 1, kick=1e-12)
    few, many = (simulate(BARE, motion, start=start, cycles=cycles).growth for cycles in (2, 3))
    assert many / few == pytest.approx(multiplier**2, rel=1e-3)


def test_a_rest_forgets_and_a_balance_forgets_nothing() -> None:
    still = simulate(BARE, Still(), start=State(angle=0.0, velocity=0.0))
    assert still.growth == 1.0
    for model in (Linear(), Nonlinear()):
        balanced = simulate(STOCKY, Still(), start=State(angle=1.0, velocity=0.0), model=model)
        assert balanced.growth == math.inf
        assert balanced.to_dict()["growth"] is None


def test_growth_of_a_slender_block_is_that_of_the_linear_model() -> None:
    block = Block.from_p(alpha=1e-3, p=2.0, restitution=0.8)
    start = State(angle=0.1, velocity=0.2)
    linear, full = (
        simulate(block, SHAKEN, cycles=5, start=start, model=model).growth
        for model in (Linear(), Nonlinear())
    )
    assert full == pytest.approx(linear, rel=1e-4)
    assert full != linear


# ------------------------------------------------------------------- uplift and friction

G = 9.80665
GROUND = Record(acceleration_m_s2=G * samples(), dt_s=0.02, name="hut")
LIFT = Record(acceleration_m_s2=2.0 * samples(9), dt_s=0.02, name="up")


def forces(run: Trajectory, rows: np.ndarray, since: np.ndarray) -> np.ndarray:
    """Return the forces over the weight at times since the start of flights, and their ratio."""
    assert isinstance(run.block, Block)
    found = np.empty((FORCES, len(rows)))
    fill_forces(run._tables, run._rows, rows, since, mass_centres(run.block), found)
    return found


@every("slope", [1.0 / 6.0, 0.3, 0.1])
@every("above", [1.3, 2.1])
@every("sign", [1.0, -1.0])
def test_friction_at_uplift_of_a_rectangle(slope: float, above: float, sign: float) -> None:
    """Shenton, J. Eng. Mech. 122, 690-693 (1996): of a rectangle that begins to rock."""
    block = Block.from_radius(alpha=math.atan(slope), radius=1.0)
    level = above * slope
    push = Segment(duration=1e-4, constant=sign * level / block.alpha)
    run = simulate(block, Piecewise(pieces=(push,)))
    first = run.rows[:, columns_of.ROW_SIDE].nonzero()[0][:1]
    ratio = forces(run, first, np.zeros(1))[FRICTION, 0]
    expected = (level * (1.0 + 4.0 * slope**2) + 3.0 * slope) / (
        4.0 + slope**2 + 3.0 * level * slope
    )
    assert ratio == pytest.approx(expected, rel=1e-12)
    assert run.uplift_g == pytest.approx(slope)
    assert run.pga_g == pytest.approx(level)
    assert run.friction_needed is not None
    assert run.friction_needed >= ratio * (1.0 - 1e-12)


@pytest.mark.parametrize("vertical", [None, LIFT])
def test_friction_is_that_of_the_path_of_the_mass_centre(vertical: Record | None) -> None:
    block = Block.rectangle(width=0.4, height=1.2)
    run = simulate(block, BaseMotion(GROUND, vertical))
    h = 1e-4  # s
    middles = (run.flights.pt + 0.5 * run.flights.duration)[run.flights.side != 0] / block.p
    long = run.flights.duration[run.flights.side != 0] / block.p > 4.0 * h
    at = middles[long][:200]
    assert len(at) > 50

    def place(t: np.ndarray) -> np.ndarray:
        """Mass centre against the base, right and up."""
        theta = run.at_time(t).angle * block.alpha
        left = block.alpha - np.abs(theta)
        right = np.sign(theta) * (block.radius * np.sin(left) - 0.5 * block.width)
        return np.array([right, block.radius * np.cos(left)])

    across, up = (place(at + h) - 2.0 * place(at) + place(at - h)) / h**2
    times = 0.02 * np.arange(len(samples()))
    # A positive acceleration of the base is to the right.
    base = np.interp(at, times, GROUND.acceleration_m_s2)
    lift = 0.0
    if vertical is not None:
        lift = np.interp(at, times[: len(vertical.acceleration_m_s2)], vertical.acceleration_m_s2)
    ratio = np.abs(base + across) / (block.gravity + lift + up)
    index = np.flatnonzero(run.flights.side)[long][:200]
    found = forces(run, index, 0.5 * run.flights.duration[index])[FRICTION]
    np.testing.assert_allclose(found, ratio, rtol=1e-3, atol=1e-4)
    assert run.friction_needed is not None
    assert run.friction_needed >= found.max()


def test_impacts_that_lose_much_need_the_friction_of_their_impulses() -> None:
    """cot(alpha) (1 - e)/(1 + e), against the jump of the mass centre's own velocity."""
    block = Block.rectangle(width=0.4, height=1.2, restitution=0.6)
    run = simulate(block, GROUND)
    impacts = run.impacts
    assert len(impacts) > 0
    after, before = impacts.velocity_after[0], impacts.velocity_before[0]
    across, up = 1.2 * abs(after - before), 0.4 * abs(after + before)  # h, b times twice each
    assert run.friction_at_impacts == pytest.approx(across / up)
    assert run.friction_at_impacts == pytest.approx(3.0 * 0.4 / 1.6)
    assert run.friction_needed == run.friction_at_impacts
    assert "0.75, for impacts" in run.summary(more=True)
    aside = Block.asymmetric(left=0.15, right=0.25, height=1.2, restitution=0.6)
    most = needed_friction(aside, 2.0).at_impact  # on either edge
    assert simulate(aside, GROUND).friction_at_impacts == pytest.approx(most)
    plain = simulate(Block.rectangle(width=0.4, height=1.2), GROUND)
    assert plain.friction_needed is not None
    assert plain.friction_needed > (plain.friction_at_impacts or 1.0)
    assert "for impacts" not in plain.summary(more=True)
    assert simulate(block.against_wall(0.5), GROUND).friction_at_impacts is None


def test_uplift_of_each_model_and_of_the_side_that_lifts_first() -> None:
    assert simulate(STOCKY, GROUND).uplift_g == pytest.approx(math.tan(0.4))
    assert simulate(STOCKY, GROUND, model=Linear()).uplift_g == pytest.approx(0.4)
    assert simulate(SKEWED, GROUND).uplift_g == pytest.approx(0.6)
    moon = Block.rectangle(width=0.4, height=2.0, gravity=1.62)  # g are of 9.80665 m/s^2 there too
    floor = floor_motion(GROUND, frequencies_hz=2.0)
    found = simulate(moon, floor)
    assert found.uplift_g == pytest.approx(0.2 * 1.62 / G)
    assert found.pga_g == pytest.approx(GROUND.peak_acceleration_m_s2 / G)
    assert found.floor_pga_g == pytest.approx(floor.peak_acceleration_m_s2 / G)
    pulse = simulate(moon, Pulse(shape="one-sine", amplitude=1.5, frequency_ratio=3.0))
    assert pulse.pga_g == pytest.approx(1.5 * moon.alpha * 1.62 / G)
    standing = simulate(STOCKY, GROUND.scaled(1e-3))
    assert standing.friction_needed == pytest.approx(standing.pga_g)
    assert standing.pga_g == pytest.approx(1e-3 * np.abs(samples()).max())


def test_what_has_no_size_or_no_end_has_no_uplift() -> None:
    for run in (simulate(BARE, Still()), simulate(STOCKY, SHAKEN, cycles=1)):
        assert run.uplift_g is run.pga_g is None
        assert not {"uplift_g", "pga_g", "friction_needed"} & set(run.to_dict())


@every("shape", ["one-sine", "ricker", "half-sine"])
def test_peak_of_a_pulse_is_that_of_its_samples(shape: str) -> None:
    run = simulate(STOCKY, Pulse(shape=shape, amplitude=1.5, frequency_ratio=3.0))
    assert isinstance(run.motion, Pulse)
    values = run.base_acceleration(np.linspace(0.0, run.motion.duration, 100_001)) * STOCKY.alpha
    assert run.pga_g == pytest.approx(np.abs(values).max(), rel=1e-6)


# ------------------------------------------------------------------------------ neighbours


def neighbours_of(scale: float, block: Block = STOCKY) -> Neighbours:
    return check_neighbours(simulate(block, GROUND.scaled(scale)))


def test_neighbours_are_those_of_the_page() -> None:
    found = neighbours_of(1.0)
    r, alpha = STOCKY.restitution, STOCKY.alpha
    cases = {
        (round(case.scale, 9), round(case.restitution - r, 9), round(case.alpha / alpha, 9))
        for case in found.cases
    }
    steps = ((0.95, 1.0, 1.05), (-0.03, 0.0, 0.03), (0.98, 1.0, 1.02))
    assert cases == set(product(*steps)) - {(1.0, 0.0, 1.0)}
    assert found.runs == 26  # none of them twice
    assert {case.sign for case in found.cases} == {1}


def test_the_sign_is_a_neighbour_where_it_matters() -> None:
    body, ground = Block.asymmetric(left=0.15, right=0.25, height=1.2), GROUND.scaled(3.0)
    tilt = State(angle=0.01, velocity=0.0)
    for block, start in ((body, Rest()), (STOCKY, tilt)):
        found = check_neighbours(simulate(block, ground, start=start))
        assert found.runs == 27
        last = found.cases[-1]
        assert (last.sign, last.scale, last.alpha) == (-1, 1.0, block.alpha)
        turned = simulate(block, ground.reversed(), start=start)
        assert last.peak == pytest.approx(turned.peak, rel=1e-9)
        assert last.peak != found.case.peak


def pushed(amplitude: float) -> Trajectory:
    return simulate(STOCKY, Pulse(shape="one-sine", amplitude=amplitude, frequency_ratio=3.0))


def test_all_fall_of_a_strong_motion_and_none_of_a_weak_one() -> None:
    strong, weak = (check_neighbours(pushed(amplitude)) for amplitude in (30.0, 1.2))
    assert weak.case.peak > 0.01
    assert (strong.fall, weak.fall) == (26, 0)
    assert strong.agree
    assert weak.agree
    assert "not robust" not in weak.summary(more=True) + strong.summary(more=True)
    assert strong.to_dict()["neighbours"] == {"runs": 26, "fall": 26}


def test_a_verdict_on_the_border_of_falling_is_not_robust() -> None:
    low, high = 1.5, 30.0
    for _ in range(20):
        middle = 0.5 * (low + high)
        falls = pushed(middle).status is Status.OVERTURNED
        low, high = (low, middle) if falls else (middle, high)
    for amplitude in (low, high):
        found = check_neighbours(pushed(amplitude))
        assert 0 < found.fall < 26
        assert not found.agree
        assert "not robust" in found.summary(more=True)
        assert fits(found.summary(more=True))


def test_a_neighbour_is_the_case_of_its_block_in_metres() -> None:
    """A rectangle of another alpha and the same height has nearly the same gyration, not quite."""
    block = Block.rectangle(width=0.4, height=1.2)
    pulse = Pulse.from_si(block, shape="one-sine", acceleration_m_s2=5.0, frequency_hz=1.5)
    found = check_neighbours(simulate(block, pulse))
    squared = (0.4**2 + 1.2**2) / 12.0
    for case in (each for each in found.cases if each.alpha != block.alpha and each.scale == 1.0):
        side = 0.6 * math.tan(case.alpha)
        other = Block.asymmetric(
            left=side, right=side, height=1.2, gyration=math.sqrt(squared),
            restitution=case.restitution,
        )  # fmt: skip
        same = Pulse.from_si(other, shape="one-sine", acceleration_m_s2=5.0, frequency_hz=1.5)
        assert case.peak == pytest.approx(simulate(other, same).peak, rel=1e-9)


def test_restitution_moves_half_way_to_its_bounds_at_most() -> None:
    for ratio, low, high in ((0.02, 0.01, 0.05), (0.98, 0.95, 0.99)):
        block = Block.from_p(alpha=0.4, p=2.0, restitution=ratio)
        cases = neighbours_of(0.5, block).cases
        ratios = [case.restitution for case in cases]
        assert (min(ratios), max(ratios)) == pytest.approx((low, high))


def test_what_has_no_neighbours_is_refused_in_a_line() -> None:
    bare = simulate(BARE, Pulse(shape="one-sine", amplitude=2.0, frequency_ratio=3.0))
    for run in (bare, simulate(STOCKY, SHAKEN, cycles=1), simulate(STOCKY, Still())):
        with pytest.raises(ModelError, match="neighbours are those of a Block") as caught:
            check_neighbours(run)
        assert "\n" not in str(caught.value)


# ------------------------------------------------------------------------ states as starts


@every("model", [Linear(), Nonlinear()])
@every("periods", [0.37, 2.0, 5.81])
def test_a_run_from_a_state_goes_on_as_the_run_itself(model: Model, periods: float) -> None:
    run = simulate(STOCKY, SHAKEN, cycles=12, model=model)
    at = periods * 2.0 * math.pi / 4.0
    start = run.state(pt=at)
    assert start.phase == pytest.approx((0.3 + 4.0 * at) % (2.0 * math.pi))
    later = simulate(STOCKY, SHAKEN, start=start, cycles=12 - periods, model=model)
    rest = run.impacts.pt[run.impacts.pt > at] - at
    assert len(rest) > 5
    np.testing.assert_allclose(later.impacts.pt[: len(rest)], rest, atol=1e-9)
    since = np.linspace(0.0, run.end_time_pt - at - 1e-9, 50)
    np.testing.assert_allclose(later(since).angle, run(at + since).angle, atol=1e-9)
    for same in (run.state(tau=4.0 * at), run.state(t_s=at / STOCKY.p)):
        assert same.angle == pytest.approx(start.angle, abs=1e-14)
        assert same.phase == pytest.approx(start.phase)


def test_a_state_needs_one_time_and_a_phase_a_harmonic_motion() -> None:
    run = simulate(BARE, SHAKEN, cycles=2)
    for times in ({}, {"pt": 1.0, "tau": 1.0}):
        with pytest.raises(ModelError, match="exactly one"):
            run.state(**times)
    with pytest.raises(ModelError, match="seconds need a block"):
        run.state(t_s=1.0)
    with pytest.raises(InputError, match="reaches from 0"):
        run.state(pt=100.0)
    with pytest.raises(ModelError, match="phase of a state"):
        simulate(BARE, Still(), start=State(angle=0.1, velocity=0.0, phase=1.0))
    assert simulate(BARE, Still(), start=State(angle=0.1, velocity=0.0)).state(pt=0.1).phase is None
    turned = State(angle=0.1, velocity=0.0, phase=1.0 - 2.0 * math.pi)
    assert turned.phase == pytest.approx(1.0)
