"""The fate after a pulse in closed form: it is what a march over the still base finds."""

import math

import numpy as np
import pytest
from numpy.typing import NDArray

from rocksteady import Block
from rocksteady.kernels.batch.pulses import pulse_fates
from rocksteady.kernels.core.clock import segment_start
from rocksteady.kernels.core.tables import (
    ALIKE,
    AT_REST,
    CEILING,
    LEAN,
    NONLINEAR_SEGMENT_COLUMNS,
    OVERTURNED,
    RATE,
    UNDECIDED,
    March,
)
from rocksteady.kernels.core.tuples import Kept, PulseFates, Tables, Until
from rocksteady.kernels.march.march import march
from rocksteady.model.equations import Nonlinear
from tests.every import every
from tests.kernels.tables import Piece, both_sides, table
from tests.strategies import sample_size

Floats = NDArray[np.float64]
Integers = NDArray[np.int64]

TURN = 2.0 * math.pi
PULSES = {
    "one-sine": (Piece(duration=TURN, amplitude=1.0, frequency=1.0),),
    "one-cosine": (Piece(duration=TURN, amplitude=1.0, frequency=1.0, phase=0.5 * math.pi),),
    "two-cosines": (Piece(duration=2.0 * TURN, amplitude=1.0, frequency=1.0, phase=0.5 * math.pi),),
    "triangle and back": (
        Piece(duration=1.0, slope=1.0),
        Piece(duration=2.0, constant=1.0, slope=-1.0),
        Piece(duration=1.0, constant=-1.0, slope=1.0),
    ),
    "steps": (Piece(duration=1.5, constant=1.0), Piece(duration=1.5, constant=-1.0)),
}


def fates(
    segments: Floats, sides: Floats, amplitude: Floats, ratio: Floats, limit: int = 10**6
) -> tuple[Integers, Integers, Integers, Integers, Floats]:
    """Status, impacts, side, impacts and side at the pulse's end, margin."""
    count = len(amplitude)
    status, impacts, side, during = (np.zeros(count, dtype=np.int64) for _ in range(4))
    margin = np.zeros(count)
    pulse_fates(
        Tables(segments, sides),
        amplitude,
        ratio,
        math.inf,
        limit,
        PulseFates(status, impacts, side, during, margin),
    )
    return status, impacts, side, during, margin


def leaning(restitution: float, lean: float, rate: float) -> Floats:
    """Sides of an asymmetric block: restitution times .9, alpha and p ratio on the second."""
    sides = both_sides(restitution)
    sides[1] = (0.9 * restitution, lean, rate)
    return sides


def drawn(seed: int, count: int) -> tuple[Floats, Floats]:
    rng = np.random.default_rng(seed)
    return 1.0 + rng.exponential(1.5, count), rng.uniform(0.5, 7.0, count)


@every("name", PULSES)
@every(("lean", "rate"), [(1.0, 1.0), (1.3, 0.7), (3.0, 2.0)])
def test_it_is_the_fate_of_a_march_that_goes_on(name: str, lean: float, rate: float) -> None:
    sides = both_sides(0.9) if lean == 1.0 else leaning(0.95, lean, rate)
    whole = table(*PULSES[name], Piece())
    amplitude, ratio = drawn(3, sample_size(150, 3))
    status, impacts, side, _, margin = fates(whole[:-1], sides, amplitude, ratio)
    half, phase = segment_start(whole, 0)
    seen = set()
    for i in range(len(amplitude)):
        own = sides.copy()
        own[:, LEAN] /= amplitude[i]
        own[:, RATE] /= ratio[i]
        start, rows = March(0, 0.0, 0.0, 0, half, phase, 0, 0), np.zeros((0, 8))
        code, end = march(
            Tables(whole, own), start, Until(0, 1e15, 0.0, 10**6), Kept(rows, np.zeros(0))
        )
        assert (status[i] == OVERTURNED) == (code == OVERTURNED) == (margin[i] > 0.0)
        seen.add(int(status[i]))
        if code == OVERTURNED:
            assert side[i] == end.side
            # Of a chatter on the way those impacts count that come before its rest is proved.
            assert impacts[i] == end.impacts or end.impacts > 40
        else:
            assert side[i] == 0
    assert len(amplitude) < 100 or seen == {AT_REST, OVERTURNED}


@pytest.mark.slow
@every("name", sample_size([*PULSES], ["one-sine"]))
@every("negative", [0.3, 0.5])
def test_it_is_the_fate_of_a_nonlinear_march_that_goes_on(name: str, negative: float) -> None:
    block = Block.from_alphas(positive=0.3, negative=negative, p=2.0, restitution=0.9)
    sides = Nonlinear().sides(block)
    narrow = table(*PULSES[name], Piece())
    whole = np.zeros((len(narrow), NONLINEAR_SEGMENT_COLUMNS))
    whole[:, :ALIKE] = narrow[:, :ALIKE]
    cut = whole[:-1].copy()
    cut[:, CEILING] = math.inf
    amplitude, ratio = drawn(4, sample_size(300, 5))
    status, impacts, side, _, margin = fates(cut, sides, 1.1 * amplitude, ratio)
    half, phase = segment_start(whole, 0)
    for i in range(len(amplitude)):
        own = sides.copy()
        own[:, LEAN] /= 1.1 * amplitude[i]
        own[:, RATE] /= ratio[i]
        start, rows = March(0, 0.0, 0.0, 0, half, phase, 0, 0), np.zeros((0, 8))
        code, end = march(
            Tables(whole, own), start, Until(0, 1e15, 0.0, 10**6), Kept(rows, np.zeros(0))
        )
        assert (status[i] == OVERTURNED) == (code == OVERTURNED) == (margin[i] > 0.0)
        if code == OVERTURNED:
            assert side[i] == end.side
            assert impacts[i] == end.impacts or end.impacts > 40


@every("down", [1.0, 1.5, 2.0])
@every(
    "block",
    [
        Block.from_p(alpha=0.6, p=2.0, restitution=0.9),
        # Of these one side comes to lie at 2.8 of its alpha and the other at 2.2 of its own.
        Block.asymmetric(left=0.5, right=0.7, height=1.6, restitution=0.9),
        Block.asymmetric(left=0.7, right=0.5, height=1.6, restitution=0.9),
    ],
)
def test_at_every_border_of_a_stocky_block_the_margin_goes_through_zero(
    block: Block, down: float
) -> None:
    # The reversal of this pulse raises a block that has all but come to lie on its side.
    sides = Nonlinear().sides(block)
    narrow = table(Piece(duration=1.5, constant=1.0), Piece(duration=2.0, constant=-down))
    segments = np.zeros((2, NONLINEAR_SEGMENT_COLUMNS))
    segments[:, :ALIKE] = narrow[:, :ALIKE]
    segments[:, CEILING] = math.inf
    grid = np.geomspace(1.2, 20.0, sample_size(2000, 20))
    for ratio in (0.8, 1.5, 3.0):

        def followed(amplitude: Floats, ratio: float = ratio) -> tuple[NDArray[np.bool_], Floats]:
            found = fates(segments, sides, amplitude, np.full(len(amplitude), ratio))
            return found[0] == OVERTURNED, found[4]

        falls, margin = followed(grid)
        assert ((margin > 0.0) == falls).all()
        for k in np.flatnonzero(falls[1:] != falls[:-1]).tolist():
            one, other = grid[k].item(), grid[k + 1].item()
            while other - one > 4.0 * np.spacing(other):
                middle = 0.5 * (one + other)
                same = followed(np.array([middle]))[0][0] == falls[k]
                one, other = (middle, other) if same else (one, middle)
            assert np.abs(followed(np.array([one, other]))[1]).max() < 1e-5


@pytest.mark.parametrize("negative", [0.42, 0.6])
def test_the_margin_of_a_block_that_stands_is_below_zero_however_strong_the_pulse(
    negative: float,
) -> None:
    block = Block.from_alphas(positive=0.42, negative=negative, p=2.0, restitution=0.72)
    narrow = table(*PULSES["one-sine"])
    segments = np.zeros((1, NONLINEAR_SEGMENT_COLUMNS))
    segments[:, :ALIKE] = narrow[:, :ALIKE]
    segments[:, CEILING] = math.inf
    amplitude = np.geomspace(1.1, 20.0, sample_size(500, 20))
    status, _, _, _, margin = fates(
        segments, Nonlinear().sides(block), amplitude, np.full(len(amplitude), 6.9)
    )
    assert ((margin > 0.0) == (status == OVERTURNED)).all()
    assert set(status.tolist()) == {AT_REST, OVERTURNED}


def test_a_block_with_unlike_sides_may_fall_after_the_second_impact_on_the_still_base() -> None:
    # What does not tip it over its heavy side may do so over the light one, on the way back.
    segments, amplitude = table(*PULSES["steps"]), np.linspace(1.0, 4.0, sample_size(4000, 100))

    def after(sides: Floats) -> set[int]:
        found = fates(segments, sides, amplitude, np.full(len(amplitude), 1.1))
        status, impacts, _, during, _ = found
        return set((impacts - (during - 1) // 3)[status == OVERTURNED].tolist())

    assert 2 in after(leaning(1.0, 3.8, 2.7))
    assert after(both_sides(0.9)) <= {0, 1}


def test_the_margin_does_not_jump_where_impacts_pass_the_end_of_the_pulse_or_flights_graze() -> (
    None
):
    segments, sides = table(*PULSES["one-cosine"]), both_sides(0.9)
    grid = np.linspace(1.1, 5.0, sample_size(40_001, 101))

    def followed(amplitude: Floats) -> tuple[Integers, Floats]:
        found = fates(segments, sides, amplitude, np.full(len(amplitude), 1.5))
        return found[3], found[4]

    during, _ = followed(grid)
    changes = np.flatnonzero(np.diff(during))
    assert len(changes) > 2
    for low, high in zip(grid[changes].tolist(), grid[changes + 1].tolist(), strict=True):
        first = followed(np.array([low]))[0][0]
        one, other = low, high
        while other - one > 4.0 * np.spacing(other):
            middle = 0.5 * (one + other)
            same = followed(np.array([middle]))[0][0] == first
            one, other = (middle, other) if same else (one, middle)
        before, after = followed(np.array([one, other]))[1]
        # A graze is seen in the square root of how far it is away.
        assert after == pytest.approx(before, abs=1e-5)


def test_a_pulse_turned_round_overturns_on_the_other_side() -> None:
    amplitude, ratio = drawn(5, sample_size(500, 10))
    sides = both_sides(0.85)
    ahead = fates(table(*PULSES["steps"]), sides, amplitude, ratio)
    mirror = table(Piece(duration=1.5, constant=-1.0), Piece(duration=1.5, constant=1.0))
    back = fates(mirror, sides, amplitude, ratio)
    for column in (0, 1, 4):
        np.testing.assert_array_equal(ahead[column], back[column])
    np.testing.assert_array_equal(ahead[2], -back[2])


def test_what_does_not_lift_rests_and_what_goes_on_too_long_is_undecided() -> None:
    one, sides = np.ones(1), both_sides(0.9)
    segments = table(*PULSES["one-cosine"])
    status, impacts, side, during, margin = fates(segments, sides, 0.999 * one, 2.0 * one)
    assert (status[0], impacts[0], side[0], during[0], margin[0]) == (AT_REST, 0, 0, 1, -1.0)
    status, _, _, _, margin = fates(segments, sides, 2.0 * one, 4.0 * one, limit=0)
    assert status[0] == UNDECIDED
    assert math.isnan(margin[0])
