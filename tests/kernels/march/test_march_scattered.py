"""Restitution that scatters: a march from impact to impact, each with the restitution drawn."""

import math

import numpy as np
import pytest
from numpy.typing import NDArray

from rocksteady.kernels.core.clock import segment_start
from rocksteady.kernels.core.tables import (
    ALPHA,
    AT_REST,
    COUNTED,
    ENDED_BY_IMPACT,
    LEAN,
    LEFT_OUT,
    NONLINEAR_SEGMENT_COLUMNS,
    NONLINEAR_SIDE_COLUMNS,
    RESTITUTION,
    ROW_COLUMNS,
    ROW_EVENT,
    ROW_SIDE,
    ROW_VELOCITY,
    SEGMENT_COLUMNS,
    SIDE_COLUMNS,
    March,
)
from rocksteady.kernels.core.tuples import Kept, Tables, Until
from rocksteady.kernels.march.march import march
from tests.every import every
from tests.kernels.scattering import draws, scattered
from tests.kernels.tables import NONE, Piece, both_sides, harmonic, run, sampled, table
from tests.records import synthetic
from tests.strategies import sample_size

Floats = NDArray[np.float64]

ALIKE, UNLIKE = (1.0, 1.0), (1.0, 1.3)
SLOWEST = 1e-90
"""Of a bounce slower than that a march may make a rest at once."""
LAWS = ((0.9, 0.05), (0.7, 0.15), (0.985, 0.1), (0.03, 0.1))


def in_model(segments: Floats, sides: Floats, *, nonlinear: bool) -> tuple[Floats, Floats]:
    """Return the tables of a model, given those of the linear one."""
    if not nonlinear:
        return segments, sides
    wide = np.zeros((len(segments), NONLINEAR_SEGMENT_COLUMNS))
    wide[:, :SEGMENT_COLUMNS] = segments
    more = np.zeros((2, NONLINEAR_SIDE_COLUMNS))
    more[:, :SIDE_COLUMNS] = sides
    more[:, ALPHA] = 0.2 * sides[:, 1]
    more[:, LEFT_OUT] = 1e-15
    return wide, more


def one_at_a_time(segments: Floats, sides: Floats, deviation: float, key: int, rows: Floats) -> int:
    """Compare flights with single ones, each with the restitution of its impact; count impacts."""
    half, phase = segment_start(segments, 0)
    state, none = March(0, 0.0, 0.0, 0, half, phase, 0, 0), np.zeros((0, ROW_COLUMNS))
    numbers = np.arange(1, len(rows) + 1)
    drawn = np.array([draws(mean, deviation, key, numbers) for mean in sides[:, RESTITUTION]])
    for row in rows:
        moving = row[ROW_SIDE : ROW_VELOCITY + 1]
        if state.angle != 0.0 or not 0.0 < abs(state.velocity) < SLOWEST:
            np.testing.assert_allclose((state.side, state.angle, state.velocity), moving, rtol=1e-8)
        fixed = sides.copy()
        fixed[:, RESTITUTION] = drawn[:, state.impacts]
        start = March(int(row[ROW_SIDE]), row[4], row[5], *place(row), state.impacts, 0)
        _, state = march(
            Tables(segments, fixed), start, Until(2**60, math.inf, 0.0, 1), Kept(none, NONE)
        )
    return state.impacts


def place(row: Floats) -> tuple[int, int, float]:
    """Return segment and clock at a row's start."""
    return int(row[0]), int(row[1]), float(row[2])


@every("nonlinear", [False, True])
@every("lean", [ALIKE, UNLIKE])
@every(("mean", "deviation"), LAWS)
def test_each_impact_has_the_restitution_of_its_number(
    mean: float, deviation: float, lean: tuple[float, float], nonlinear: bool
) -> None:
    rng = np.random.default_rng(11)
    reached = 0
    values = synthetic(rng, 400, 0.05, 3.0)
    for key, flat in enumerate((harmonic(3.0, 5.0), sampled(values, 0.05))):
        plain = both_sides((mean, 0.95 * mean), lean)
        segments, sides = in_model(flat, plain, nonlinear=nonlinear)
        wide = scattered(sides, deviation, key + 2**40)
        ran = run(segments, wide, rest_velocity=0.0, limit=sample_size(300, 25))
        assert ran.end.impacts == one_at_a_time(segments, sides, deviation, key + 2**40, ran.rows)
        reached += int(np.count_nonzero(ran.rows[:, ROW_EVENT] == ENDED_BY_IMPACT))
    assert reached > sample_size(100, 10)


@pytest.mark.parametrize("nonlinear", [False, True])
def test_without_deviation_a_march_keeps_its_bits(nonlinear: bool) -> None:
    values = synthetic(np.random.default_rng(12), 300, 0.05, 2.5)
    for lean in (ALIKE, UNLIKE):
        segments, sides = in_model(
            sampled(values, 0.05), both_sides((0.8, 0.9), lean), nonlinear=nonlinear
        )
        plain, wide = run(segments, sides), run(segments, scattered(sides, 0.0, 9))
        assert (plain.status, plain.end) == (wide.status, wide.end)
        np.testing.assert_array_equal(plain.rows, wide.rows)
        assert plain.end.impacts > 3
        assert run(segments, scattered(sides, 0.05, 9)).end != plain.end


@every("nonlinear", [False, True])
@every(("mean", "deviation"), LAWS)
def test_free_rocking_loses_energy_and_chatter_dies_out_as_proved(
    mean: float, deviation: float, nonlinear: bool
) -> None:
    segments, sides = in_model(table(Piece()), both_sides(mean, UNLIKE), nonlinear=nonlinear)
    for key in range(sample_size(40, 4)):
        wide = scattered(sides, deviation, key)
        early = run(segments, wide, side=1, velocity=0.6, rest_velocity=math.inf)
        late = run(segments, wide, side=1, velocity=0.6, rest_velocity=1e-12)
        assert early.status == late.status == AT_REST
        both = min(len(early.rows), len(late.rows)) - 1
        np.testing.assert_array_equal(early.rows[:both], late.rows[:both])
        struck = np.flatnonzero(late.rows[:-1, ROW_EVENT] == ENDED_BY_IMPACT)
        struck = struck[late.rows[struck + 1, ROW_SIDE] != 0.0]
        # The slower ones share the draw of the next that counts.
        leans = wide[np.where(late.rows[struck + 1, ROW_SIDE] > 0.0, 0, 1), LEAN]
        struck = struck[np.abs(late.rows[struck + 1, ROW_VELOCITY]) >= COUNTED * leans]
        assert early.end.impacts == late.end.impacts == len(struck)
        # On a base that stands still a flight comes back as fast as it began.
        shares = late.rows[struck + 1, ROW_VELOCITY] / late.rows[struck, ROW_VELOCITY]
        drawn = draws(mean, deviation, key, np.arange(1, len(struck) + 1))
        np.testing.assert_allclose(np.abs(shares), drawn, rtol=1e-9)
        # All that the proof leaves out lies within what it allows for.
        left_out = late.durations()[both:-1].sum()
        speed = abs(late.rows[both, ROW_VELOCITY]) if both < len(late.rows) - 1 else 0.0
        assert left_out <= 4.0 * speed / (1.0 - speed) / (1.0 - 0.5 * (1.0 + mean)) + 1e-12


def test_a_block_proved_to_rest_lifts_where_one_that_bounces_on_does() -> None:
    rests = 0
    for key in range(sample_size(400, 18)):
        rng = np.random.default_rng(key)
        segments = harmonic(rng.uniform(1.02, 1.3), 10.0 ** rng.uniform(-0.5, 0.5))
        sides = scattered(both_sides(rng.uniform(0.5, 0.9), UNLIKE), rng.uniform(0.05, 0.3), key)
        early, late = (
            run(segments, sides, half_cycles=8, limit=9000, rest_velocity=slow)
            for slow in (math.inf, 1e-40)
        )
        first, longer = first_rest(early.rows), first_rest(late.rows)
        if first == 0:
            continue
        rests += 1
        # What follows has other draws: the bounces that are left out are counted in the other.
        np.testing.assert_array_equal(early.rows[:first], late.rows[:first])
        assert longer >= first
        ends = [place(ran.rows[at + 1]) for ran, at in ((early, first), (late, longer))]
        assert ends[0] == ends[1]
    assert rests > sample_size(100, 2)


def first_rest(rows: Floats) -> int:
    """Return the row of the first rest after a motion that another motion follows, or 0."""
    rests = np.flatnonzero(rows[:-1, ROW_SIDE] == 0.0)
    return int(rests[rests > 0].min(initial=len(rows))) % len(rows)
