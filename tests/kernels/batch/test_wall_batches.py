"""Batches of blocks against a wall: each cell fares as its march, next to cells of two sides."""

import math
from collections.abc import Callable

import numpy as np
import pytest
from numpy.typing import NDArray

from rocksteady.dynamics.batch.fates import ends_of
from rocksteady.kernels.batch._lossless_bound import largest_margin
from rocksteady.kernels.batch._still_base import fate_on_still_base, over_the_top
from rocksteady.kernels.batch.harmonic import fates_of_sides
from rocksteady.kernels.batch.pulses import pulse_fates
from rocksteady.kernels.batch.records import FEW, record_fates
from rocksteady.kernels.batch.waiting import fill_hardest, waits_until
from rocksteady.kernels.core.clock import segment_start
from rocksteady.kernels.core.tables import (
    AT_REST,
    CONSTANT,
    ENDED_BY_IMPACT,
    LEAN,
    OVERTURNED,
    RATE,
    ROCKING,
    ROW_COLUMNS,
    ROW_EVENT,
    ROW_SIDE,
    SAFELY,
    SLOPE,
    UNDECIDED,
    March,
)
from rocksteady.kernels.core.tuples import (
    Blocks,
    Cells,
    Fates,
    Kept,
    PeakFates,
    PulseFates,
    Starts,
    Tables,
    Until,
)
from rocksteady.kernels.march.march import march
from rocksteady.kernels.march.replay import recorded_peaks
from rocksteady.kernels.nonlinear_lanes.loop import nonlinear_lane_fates
from tests.every import every
from tests.kernels.scattering import draws, scattered
from tests.kernels.tables import NONE, Piece, both_sides, harmonic, run, sampled, table
from tests.kernels.walls import against_wall, in_model
from tests.records import synthetic
from tests.strategies import sample_size

Floats = NDArray[np.float64]
Integers = NDArray[np.int64]

TURN = 2.0 * math.pi
NOBODY = np.zeros((0, ROW_COLUMNS))
ENOUGH = 10**6


def tabled(segments: Floats, sides: list[Floats], alpha: float) -> tuple[Floats, Floats]:
    """Return the tables of a model, the sides of all blocks in one."""
    return (
        in_model(segments, sides[0], alpha)[0],
        np.array([in_model(segments, one, alpha)[1] for one in sides]),
    )


def walls(rng: np.random.Generator, count: int, *, free: int = 1) -> list[Floats]:
    """Return blocks against a wall, every fifth of which it does not throw back."""
    return [
        against_wall(0.0 if i % 5 == 0 else float(rng.uniform(0.1, 1.0)), free=free)
        for i in range(count)
    ]


# ---------------------------------------------------------------------------- harmonic shaking


@pytest.mark.parametrize("alpha", [0.0, 0.3])
def test_cells_against_a_wall_and_on_two_sides_do_not_disturb_each_other(alpha: float) -> None:
    rng = np.random.default_rng(1)
    count, cycles = sample_size(80, 10), sample_size(40, 6)
    amplitude, frequency = rng.uniform(0.8, 3.0, count), rng.uniform(1.5, 8.0, count)
    velocity = rng.uniform(0.0, 0.4, count)
    velocity[::3] = 0.0
    blocks = walls(rng, count)
    for i in range(1, count, 4):
        blocks[i] = both_sides(0.8)
    _, sides = tabled(harmonic(1.0, 1.0), blocks, alpha)
    zeros = np.zeros(count)

    def fates(kernel: Callable[..., None], cells: NDArray[np.int64]) -> Fates:
        status, impacts = np.zeros((2, len(cells)), np.int64)
        found = Fates(status, impacts, np.empty((len(cells), 3)))
        shaken = Cells(amplitude[cells], frequency[cells], sides[cells])
        starts = Starts(zeros[cells], velocity[cells], zeros[cells])
        ends = (cycles, True, ENOUGH) if kernel is nonlinear_lane_fates else (cycles, ENOUGH)
        kernel(shaken, starts, *ends, found)
        return found

    every = np.arange(count)
    alone = np.array([sides[i, 0, 0] <= 0.0 for i in every])
    status, impacts, final = fates(fates_of_sides, every)
    for i in every[alone][: sample_size(20, 4)].tolist():
        segments = in_model(harmonic(amplitude[i], frequency[i]), blocks[i], alpha)[0]
        side = 1 if velocity[i] > 0.0 else 0
        begin = March(side, 0.0, velocity[i], 0, 0, 0.0, 0, 0)
        code, end = march(
            Tables(segments, sides[i]),
            begin,
            Until(2 * cycles, 0.0, math.inf, ENOUGH),
            Kept(NOBODY, NONE),
        )
        assert (code, end.impacts, end.angle) == (status[i], impacts[i], final[i, 0])
    assert np.all(final[alone, 0] >= 0.0)
    assert set(status[alone].tolist()) >= ({ROCKING, OVERTURNED} if count > 20 else set())
    if alpha:
        lanes = fates(nonlinear_lane_fates, every)
        np.testing.assert_array_equal(lanes[0][alone], status[alone])
        np.testing.assert_array_equal(lanes[1][alone], impacts[alone])
        np.testing.assert_array_equal(lanes[2][alone], final[alone])
        two = fates(nonlinear_lane_fates, every[~alone])
        for one, other in zip(lanes, two, strict=True):
            np.testing.assert_array_equal(one[~alone], other)
    ends = ends_of(
        amplitude=amplitude,
        frequency_ratio=frequency,
        sides=sides,
        angle=zeros,
        velocity=velocity,
        phase=zeros,
        cycles=cycles,
        harmonics=(),
    )
    # Lanes of the linear model agree to rounding, which some of these motions amplify.
    amplitude *= 1.0 + 1e-12
    firm = alone & (fates(fates_of_sides, every).impacts == impacts)
    assert np.count_nonzero(firm) >= 0.8 * np.count_nonzero(alone)
    np.testing.assert_array_equal(ends[firm], status[firm])


# -------------------------------------------------------------------------------------- records


@pytest.mark.parametrize("alpha", [0.0, 0.3])
def test_under_a_record_peaks_are_those_of_the_rows_and_of_the_mirror_image(alpha: float) -> None:
    rng = np.random.default_rng(3)
    count = sample_size(24, FEW + 2)
    flat = sampled(synthetic(rng, 500, 0.05, 3.0), 0.05)
    turned = flat.copy()
    turned[:, [CONSTANT, SLOPE]] *= -1.0
    reached = []
    for segments, free in ((flat, 1), (turned, -1)):
        blocks = walls(np.random.default_rng(4), count, free=free)
        wide, sides = tabled(segments, blocks, alpha)
        sides[:, :, LEAN] = np.geomspace(0.3, 4.0, count)[:, np.newaxis]
        sides[:, :, RATE] = 1.2
        status, impacts = np.zeros(count, np.int64), np.zeros(count, np.int64)
        peaks = np.zeros((count, 2))
        record_fates(
            wide, Blocks(sides, np.full(count, 60.0)), ENOUGH, PeakFates(status, impacts, peaks)
        )
        reached.append((status, impacts, peaks))
        if free < 0:
            break
        hardest = np.empty(len(wide) - 1)
        fill_hardest(wide, alpha > 0.0, hardest)
        for i in range(count):
            ran = run(wide, sides[i], until=25.0 + 60.0 / 1.2, rest_velocity=1e-12)
            assert np.all(ran.rows[:, ROW_SIDE] >= 0.0)
            assert (ran.status == OVERTURNED) == (status[i] == OVERTURNED)
            assert ran.end.impacts == impacts[i]
            if status[i] != OVERTURNED:
                last = float(ran.rows[-1, 6])
                positive, negative, speed = recorded_peaks(wide, sides[i], ran.rows, last)
                assert negative == 0.0
                assert peaks[i, 0] == pytest.approx(positive, rel=1e-12)
                unit = sides[i, 0, LEAN] * sides[i, 0, RATE]
                assert peaks[i, 1] == pytest.approx(speed / unit, rel=1e-12)
            # It waits for what lifts its one side, however weak the other's row is.
            weak = sides[i].copy()
            weak[1, LEAN] = 1e-9
            assert waits_until(hardest, weak) == waits_until(hardest, sides[i])
            uplift = sides[i, 0, LEAN] * (math.tan(alpha) / alpha if alpha else 1.0)
            waits = waits_until(hardest, sides[i])
            assert waits == len(hardest) or hardest[waits] >= SAFELY * uplift * (1.0 - 1e-9)
    for one, other in zip(*reached, strict=True):
        np.testing.assert_array_equal(one, other)
    assert {OVERTURNED, AT_REST} <= set(reached[0][0].tolist()) or count < 24


@every("alpha", [0.0, 0.3])
@every(("mean", "deviation"), [(0.5, 0.05), (0.9, 0.2), (0.0, 0.1)])
def test_restitution_that_scatters_is_drawn_for_each_impact_on_the_wall(
    mean: float, deviation: float, alpha: float
) -> None:
    key, limit = 77, sample_size(200, 40)
    segments, sides = in_model(harmonic(1.2, 7.0), against_wall(mean), alpha)
    ran = run(segments, scattered(sides, deviation, key), rest_velocity=0.0, limit=limit)
    drawn = draws(mean, deviation, key, np.arange(1, limit + 1))
    assert np.count_nonzero(ran.rows[:, ROW_EVENT] == ENDED_BY_IMPACT) > 10
    state = None
    for row in ran.rows:
        if state is not None and state.velocity > 1e-80:
            np.testing.assert_allclose((state.side, state.velocity), row[[3, 5]], rtol=1e-12)
        impacts = 0 if state is None else state.impacts
        # Those too slow to count share the draw of the next that counts.
        fixed = sides.copy()
        fixed[0, 0] = -drawn[impacts]
        begin = March(int(row[3]), row[4], row[5], int(row[0]), int(row[1]), row[2], impacts, 0)
        _, state = march(
            Tables(segments, fixed), begin, Until(2**60, math.inf, 0.0, 1), Kept(NOBODY, NONE)
        )
    assert state is not None
    assert state.impacts == ran.end.impacts
    certain = run(segments, scattered(sides, 0.0, key), rest_velocity=0.0, limit=limit)
    plain = run(segments, sides, rest_velocity=0.0, limit=limit)
    assert certain.end == plain.end
    np.testing.assert_array_equal(certain.rows, plain.rows)


# --------------------------------------------------------------------------------------- pulses


@every("alpha", [0.0, 0.4])
@every("e", [0.0, 0.5, 0.9, 1.0])
def test_on_a_still_base_the_fate_is_that_of_a_march(e: float, alpha: float) -> None:
    rng = np.random.default_rng(5)
    segments, sides = in_model(table(Piece()), against_wall(e, 0.9, 1.3), alpha)
    lean, rate = sides[0, LEAN], sides[0, RATE]
    fates = set()
    for _ in range(sample_size(300, 20)):
        angle, velocity = float(rng.uniform(0.0, 1.9)), float(rng.normal(0.0, 1.5))
        top = over_the_top(sides, 0, angle)
        if math.isclose(abs(velocity), abs(top), rel_tol=1e-6) or angle == 0.0:
            continue
        fate = fate_on_still_base(sides, 1, angle, velocity)
        start = March(1, angle * lean, velocity * lean * rate, 0, 0, 0.0, 0, 0)
        code, end = march(
            Tables(segments, sides), start, Until(0, 150.0, math.inf, 10**4), Kept(NOBODY, NONE)
        )
        assert (fate.margin > 0.0) == (code == OVERTURNED), (angle, velocity)
        assert fate.side == 1
        if code == OVERTURNED:
            assert fate.impacts == end.impacts <= 1
        fates.add((code, fate.impacts))
    assert (OVERTURNED, 0) in fates
    assert ((OVERTURNED, 1) in fates) == (e > 0.0) or sample_size(0, 1)
    # Rising by its own restitution it just reaches the top: the margin there is 0.
    if e > 0.0:
        fast = -over_the_top(sides, 0, 0.0) / e
        falling = -math.sqrt(fast * fast + over_the_top(sides, 0, 0.5) ** 2)
        falling = -math.sqrt(falling**2 - over_the_top(sides, 0, 0.0) ** 2)
        assert fate_on_still_base(sides, 1, 0.5, falling).margin == pytest.approx(0.0, abs=1e-12)


@every("alpha", [0.0, 0.3])
@every("e", [0.0, 0.6, 1.0])
@every("free", [1, -1])
def test_fates_of_pulses_are_those_of_marches_that_go_on(e: float, alpha: float, free: int) -> None:
    rng = np.random.default_rng(6)
    count = sample_size(200, 8)
    amplitude, ratio = 1.0 + rng.exponential(1.5, count), rng.uniform(0.5, 6.0, count)
    pulse = (Piece(duration=TURN, amplitude=1.0, frequency=1.0),)
    whole, sides = in_model(table(*pulse, Piece()), against_wall(e, free=free), alpha)
    if alpha:
        sides[:, LEAN] *= alpha / math.tan(alpha)
    status, impacts, side, during = (np.zeros(count, np.int64) for _ in range(4))
    margin = np.zeros(count)
    pulse_fates(
        Tables(whole[:-1], sides),
        amplitude,
        ratio,
        math.inf,
        10**5,
        PulseFates(status, impacts, side, during, margin),
    )
    half, phase = segment_start(whole, 0)
    start = March(0, 0.0, 0.0, 0, half, phase, 0, 0)
    for i in range(count):
        own = sides.copy()
        own[:, LEAN] /= amplitude[i]
        own[:, RATE] /= ratio[i]
        code, _ = march(
            Tables(whole, own),
            start,
            Until(0, 100.0 * ratio[i], math.inf, 10**5),
            Kept(NOBODY, NONE),
        )
        if code == UNDECIDED:  # of a block that loses nothing bounces may have no end
            assert e == 1.0
            assert margin[i] < 0.0
            continue
        assert (status[i] == OVERTURNED) == (code == OVERTURNED) == (margin[i] > 0.0)
        assert side[i] == (free if code == OVERTURNED else 0)
    assert {AT_REST, OVERTURNED} == set(status.tolist()) or count < 20


@pytest.mark.slow
@every("alpha", [0.0, 0.3])
@every("free", [1, -1])
def test_without_loss_a_march_that_goes_on_stays_below_the_bound(alpha: float, free: int) -> None:
    proved = 0
    for part in np.geomspace(1e-3, 0.3, sample_size(6, 3)).tolist():
        for ratio in (0.5, 1.0, 4.0):
            pulse = table(Piece(duration=TURN, amplitude=1.0, frequency=1.0))
            segments, sides = in_model(pulse, against_wall(1.0, free=free), alpha)
            sides[:, LEAN] /= (1.0 + part) * (math.tan(alpha) / alpha if alpha else 1.0)
            sides[:, RATE] /= ratio
            start = March(0, 0.0, 0.0, 0, *segment_start(segments, 0), 0, 0)
            last, final = march(
                Tables(segments, sides), start, Until(0, 0.0, 0.0, 10**5), Kept(NOBODY, NONE)
            )
            for flights in (6, 20, 100):
                code, end = march(
                    Tables(segments, sides), start, Until(0, 0.0, 0.0, flights), Kept(NOBODY, NONE)
                )
                if code != UNDECIDED or last == UNDECIDED:
                    break
                bound = largest_margin(segments, sides, end)
                if bound == math.inf:
                    continue
                proved += 1
                assert -1.0 <= bound < 0.0
                assert last == ROCKING
                row = 0 if free > 0 else 1
                unit = sides[row, LEAN] * sides[row, RATE]
                margin = fate_on_still_base(
                    sides,
                    final.side,
                    final.side * final.angle / sides[row, LEAN],
                    final.side * final.velocity / unit,
                ).margin
                assert margin <= bound + 1e-12
    assert proved > sample_size(5, -1)
