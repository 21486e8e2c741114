"""Runs of samples in the nonlinear model against each sample on its own, and by invariants."""

import math
from collections.abc import Callable

import numpy as np
import pytest
from numpy.typing import NDArray

from rocksteady.kernels.core.tables import (
    ALIKE,
    ALPHA,
    AT_REST,
    CEILING,
    CONSTANT,
    DURATION,
    LEFT_OUT,
    LIFT,
    LIFT_SLOPE,
    LOST_CONTACT,
    NONLINEAR_SIDE_COLUMNS,
    OVERTURNED,
    PEAK_ANGLE,
    ROW_ANGLE,
    ROW_EVENT,
    ROW_SEGMENT,
    ROW_SIDE,
    ROW_VELOCITY,
    SLOPE,
    UNDECIDED,
    March,
)
from rocksteady.kernels.core.tuples import Kept, Tables, Until
from rocksteady.kernels.march.march import march
from rocksteady.kernels.march.replay import recorded_peaks
from rocksteady.model.nonlinear_tables import lifted_table
from tests.every import every
from tests.kernels.tables import PLENTY, Run, both_sides, one_by_one, run, sampled
from tests.records import el_centro, rinaldi, synthetic
from tests.strategies import sample_size

Floats = NDArray[np.float64]


def nonlinear_sides(
    restitution: float | tuple[float, float],
    alpha: float | tuple[float, float],
    lean: tuple[float, float] = (1.0, 1.0),
    rate: tuple[float, float] = (1.0, 1.0),
) -> Floats:
    sides = np.zeros((2, NONLINEAR_SIDE_COLUMNS))
    sides[:, :ALPHA] = both_sides(restitution, lean, rate)
    sides[:, ALPHA] = alpha
    sides[:, LEFT_OUT] = 1e-15
    return sides


def random_sides(rng: np.random.Generator) -> Floats:
    alpha = math.exp(rng.uniform(math.log(0.003), math.log(0.9)))
    if rng.random() < 0.6:
        return nonlinear_sides(rng.uniform(0.5, 1.0), alpha)
    lean, rate = rng.uniform(0.6, 1.5, 2), rng.uniform(0.7, 1.4, 2)
    return nonlinear_sides(
        (rng.uniform(0.5, 0.99), rng.uniform(0.5, 0.99)),
        (alpha * lean[0], alpha * lean[1]),
        (lean[0], lean[1]),
        (rate[0], rate[1]),
    )


def random_motion(rng: np.random.Generator, lifted: bool) -> tuple[Floats, Floats]:
    """Return samples and the sides of a block that they may lift, rock, throw up or overturn."""
    step, count = rng.uniform(0.004, 0.16), int(rng.integers(100, sample_size(1000, 120)))
    sides = random_sides(rng)
    uplift = math.tan(sides[0, ALPHA]) / sides[0, ALPHA]
    values = synthetic(rng, count, 0.01, 1.0) * (uplift * 10.0 ** rng.uniform(-0.2, 0.8))
    flat = sampled(values, step)
    if not lifted:
        return lifted_table(flat), sides
    # Vertical samples at the same instants, at twice as many, or elsewhere.
    share = rng.choice([1.0, 0.5, 0.77, 1.31])
    heave = synthetic(rng, int(count / share), 0.01, rng.choice([0.3, 0.8, 1.3]))
    return lifted_table(flat, sampled(heave, step * share)), sides


def impact_times(ran: Run) -> Floats:
    """Return the times of the impacts that leave more than a trembling."""
    starts = np.concatenate([[0.0], np.cumsum(ran.segments[:-1, DURATION])])
    rows = ran.rows
    after = np.flatnonzero(rows[:-1, ROW_EVENT] == 1) + 1
    after = after[np.abs(rows[after, ROW_VELOCITY]) > 1e-5]
    return np.asarray(starts[rows[after, ROW_SEGMENT].astype(int)] + rows[after, 2])


def peaks_of(segments: Floats, sides: Floats, limit: int = PLENTY) -> tuple[int, March, Floats]:
    start, peaks = March(0, 0.0, 0.0, 0, 0, 0.0, 0, 0), np.zeros(2)
    none = np.zeros((0, 8))
    status, end = march(
        Tables(segments, sides), start, Until(0, math.inf, math.inf, limit), Kept(none, peaks)
    )
    return status, end, peaks


def marches_alike(
    segments: Floats, sides: Floats, angle: float = 0.0, velocity: float = 0.0
) -> Run | None:
    """Compare with the march of each segment on its own; None where rounding decides.

    Rocking amplifies rounding: what a jolt in the last digits of the motion makes is the measure.
    """
    jolted = one_by_one(segments)
    jolted[:, [CONSTANT, SLOPE, CEILING]] *= 1.0 + 1e-15
    side = int(np.sign(angle)) or int(np.sign(velocity))
    exact = sides.copy()  # steps of more terms: what is left out of the others adds up as well
    exact[:, LEFT_OUT] = 1e-20
    fast, slow, other = (
        run(table, own, side=side, angle=angle, velocity=velocity)
        for table, own in ((segments, sides), (one_by_one(segments), exact), (jolted, exact))
    )
    at, truth, moved = (impact_times(ran) for ran in (fast, slow, other))
    if (slow.status, len(truth)) != (other.status, len(moved)):
        return None
    if np.abs(truth - moved).max(initial=0.0) > 1e-6:
        return None
    assert (fast.status, fast.end.side, len(at)) == (slow.status, slow.end.side, len(truth))
    swell = np.maximum.accumulate(np.abs(truth - moved)) if len(truth) else truth
    assert np.all(np.abs(at - truth) <= 1e-10 + 100.0 * swell)
    if fast.status in {OVERTURNED, LOST_CONTACT}:
        assert fast.end.segment == slow.end.segment
    if len(fast.rows) == len(slow.rows):  # it did not tremble
        whole = [ROW_SEGMENT, ROW_SIDE, ROW_EVENT]
        if np.array_equal(slow.rows[:, whole], other.rows[: len(slow.rows), whole]):
            np.testing.assert_array_equal(fast.rows[:, whole], slow.rows[:, whole])
            state = [ROW_ANGLE, ROW_VELOCITY]
            apart = np.abs(slow.rows[:, state] - other.rows[:, state]).max()
            np.testing.assert_allclose(
                fast.rows[:, state], slow.rows[:, state], rtol=0.0, atol=1e-10 + 100.0 * apart
            )
    return fast


@pytest.mark.slow
@pytest.mark.parametrize("lifted", [False, True])
def test_a_run_marches_as_its_segments_one_by_one(lifted: bool) -> None:
    rng = np.random.default_rng(1994)
    cases = sample_size(250, 4)
    runs = []
    for _ in range(cases):
        segments, sides = random_motion(rng, lifted)
        start = rng.normal(0.0, 0.3, 2) if rng.random() < 0.4 else np.zeros(2)
        if start[0] * start[1] < 0.0 and rng.random() < 0.5:
            start[0] = 0.0  # thrown off the ground
        runs.append(marches_alike(segments, sides, *start.tolist()))
    compared = [ran.status for ran in runs if ran is not None]
    assert len(compared) > 0.8 * cases
    if cases > 100:
        assert min(compared.count(AT_REST), compared.count(OVERTURNED)) > 30
        assert (compared.count(LOST_CONTACT) > 10) == lifted


@every("lifted", [False, True])
@every("record", [el_centro, rinaldi])
@every(
    ("p", "uplift", "alpha"),
    sample_size(
        [(1.5, 2.5, 0.25), (2.5, 1.5, 0.15), (5.0, 2.0, 0.2), (2.0, 2.2, 0.5)], [(2.0, 2.2, 0.5)]
    ),
)
def test_a_real_record_marches_as_its_segments_one_by_one(
    record: Callable[[], tuple[Floats, float]],
    p: float,
    uplift: float,
    alpha: float,
    lifted: bool,
) -> None:
    values, step = record()
    values = values[: sample_size(len(values), 600)]
    flat = sampled(values / uplift, step * p)
    # As vertical motion the record itself, later and half as strong.
    heave = sampled(0.5 * values[40:] / 9.81, step * p)
    segments = lifted_table(flat, heave) if lifted else lifted_table(flat)
    assert np.count_nonzero(segments[:, ALIKE]) > 0.9 * len(values)
    ran = marches_alike(segments, nonlinear_sides(0.9, alpha))
    assert ran is not None
    assert ran.end.impacts > 0


def test_peaks_of_a_run_are_those_of_its_segments_and_of_its_rows() -> None:
    rng = np.random.default_rng(77)
    compared = 0
    for case in range(sample_size(120, 4)):
        segments, sides = random_motion(rng, case % 2 == 1)
        ran = run(segments, sides)
        status, end, peaks = peaks_of(segments, sides)
        assert (status, end) == (ran.status, ran.end), "watching changes nothing"
        if status == OVERTURNED or ran.rows[-1, ROW_EVENT] == 2:
            continue
        *own, swift = recorded_peaks(segments, sides, ran.rows, float(ran.rows[-1, 6]))
        assert peaks[PEAK_ANGLE] == pytest.approx(max(own), rel=1e-12)
        assert peaks[1] == pytest.approx(swift, rel=1e-12)
        if marches_alike(segments, sides) is None:
            continue
        again, same, slow = peaks_of(one_by_one(segments), sides)
        assert again == status
        if same.impacts == end.impacts:
            np.testing.assert_allclose(peaks, slow, rtol=1e-7)
            compared += 1
    assert compared > sample_size(20, 0)


def test_the_mirrored_march_is_the_same_to_the_last_bit() -> None:
    rng = np.random.default_rng(11)
    compared = 0
    for _ in range(sample_size(30, 2)):
        segments, sides = random_motion(rng, True)
        turned = segments.copy()
        turned[:, [CONSTANT, SLOPE]] *= -1.0
        one, other = run(segments, sides), run(turned, sides[::-1].copy())
        assert one.status == other.status
        mirrored = other.rows.copy()
        mirrored[:, [ROW_SIDE, ROW_ANGLE, ROW_VELOCITY]] *= -1.0
        if np.array_equal(sides[0, 1:], sides[1, 1:]):  # the first side's units are the reference
            np.testing.assert_array_equal(one.rows, mirrored)
            compared += one.end.impacts > 3
    assert compared > sample_size(5, 0)


@every("limit", [1, 2, 57, 400, 1001])
def test_the_limit_of_flights_is_kept(limit: int) -> None:
    rng = np.random.default_rng(5)
    segments = lifted_table(sampled(synthetic(rng, 1200, 0.02, 2.0), 0.02))
    sides = nonlinear_sides(0.8, 0.3)
    whole, part = run(segments, sides), run(segments, sides, limit=limit)
    assert len(whole.rows) > limit
    assert (part.status, part.end.flights, len(part.rows)) == (UNDECIDED, limit, limit)
    np.testing.assert_array_equal(part.rows, whole.rows[:limit])
    assert peaks_of(segments, sides, limit)[:2] == (part.status, part.end)


@every("alpha", [1e-4, 0.2, 1.2])
@every("step", [0.01, 0.2, 0.6])
def test_without_loss_a_free_block_keeps_its_energy(alpha: float, step: float) -> None:
    # y'' = -sin(alpha (1 - y))/alpha keeps v^2/2 - 2 sin^2(alpha (1 - y)/2)/alpha^2.
    count = sample_size(20_000, 250)
    segments = lifted_table(sampled(np.zeros(count), step))
    ran = run(segments, nonlinear_sides(1.0, alpha), side=1, velocity=0.7, until=count * step)
    assert ran.end.impacts > count * step / 10.0
    angle, velocity = np.abs(ran.rows[:, ROW_ANGLE]), ran.rows[:, ROW_VELOCITY]

    def height(y: Floats | float) -> Floats:
        return np.asarray(-2.0 * (np.sin(0.5 * alpha * (1.0 - np.asarray(y))) / alpha) ** 2)

    kept = 0.5 * velocity**2 + height(angle) - height(0.0)
    np.testing.assert_allclose(kept, 0.245, rtol=0.0, atol=2e-15 * count)


@every("sign", [1.0, -1.0])
@every("lift", [0.0, 0.4, -0.4])
def test_uplift_is_where_the_line_between_two_samples_crosses(sign: float, lift: float) -> None:
    alpha = (0.3, 0.21)
    side = 0 if sign > 0.0 else 1
    level = (1.0, 0.7)[side] * math.tan(alpha[side]) / alpha[side] * (1.0 + lift)
    sides = nonlinear_sides(0.8, alpha, (1.0, 0.7))
    values = sign * level * np.array([0.0, 0.3, -0.4, 0.1, 0.5, 1.1, 0.2, 0.0, 0.0])
    segments = lifted_table(sampled(values, 0.25), sampled(np.full(9, lift), 0.25))
    ran = run(segments, sides, until=3.0)
    lifted = int(np.flatnonzero(ran.rows[:, ROW_EVENT] == 3)[0])
    assert ran.rows[lifted, ROW_SEGMENT] == 4
    assert ran.rows[lifted, 6] == pytest.approx(0.25 * 0.5 / 0.6, rel=1e-14)
    assert ran.rows[lifted + 1, ROW_SIDE] == sign


@pytest.mark.parametrize("start", [(0.0, 0.0), (0.3, 0.1)])
def test_a_base_that_falls_away_ends_the_run_where_the_weight_is_gone(
    start: tuple[float, float],
) -> None:
    heave = np.array([0.0, 0.2, 0.0, -0.3, -0.8, -1.3, -0.5, 0.0, 0.0])
    segments = lifted_table(sampled(np.zeros(9), 0.1), sampled(heave, 0.1))
    for table in (segments, one_by_one(segments)):
        ran = run(
            table,
            nonlinear_sides(0.9, 0.3),
            side=int(start[0] > 0),
            angle=start[0],
            velocity=start[1],
        )
        assert (ran.status, ran.end.segment) == (LOST_CONTACT, 4)
        assert ran.end.phase == pytest.approx(0.1 * 0.2 / 0.5, rel=1e-12)


# ----------------------------------------------------------------------- the tables of runs


@every("share", [1.0, 0.5, 0.25, 2.0, 0.77, 1.31])
def test_runs_of_a_table_with_vertical_samples_are_alike_throughout(share: float) -> None:
    rng = np.random.default_rng(3)
    flat, heave = rng.normal(size=101), 0.3 * rng.normal(size=round(100 / share) + 1)
    step = 0.0137
    table = lifted_table(sampled(flat, step), sampled(heave, step * share))
    starts = np.concatenate([[0.0], np.cumsum(table[:-1, DURATION])])
    for i, alike in enumerate(table[:, ALIKE].astype(int)):
        own = table[i : i + alike + 1]
        assert np.all(own[:, DURATION] == own[0, DURATION])
        assert not own[:, 4:6].any()
        assert not own[1:, 1].any()
        if alike:
            assert math.isfinite(own[0, DURATION])
            assert table[i + 1, ALIKE] == alike - 1
    inner = starts[:-1] + 0.4 * table[:-1, DURATION]
    since = 0.4 * table[:-1, DURATION]
    across = table[:-1, CONSTANT] + table[:-1, SLOPE] * since
    up = table[:-1, LIFT] + table[:-1, LIFT_SLOPE] * since
    for found, values, dt in ((across, flat, step), (up, heave, step * share)):
        times = dt * np.arange(len(values))
        within = inner < times[-1]
        np.testing.assert_allclose(
            found[within], np.interp(inner[within], times, values), rtol=0.0, atol=1e-11
        )
    if share == 1.0:
        assert table[0, ALIKE] == len(heave) - 2
