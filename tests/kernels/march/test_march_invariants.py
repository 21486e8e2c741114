"""What may not change a march: mirrors, cuts, records, limits; and no drift."""

import math

import numpy as np
import pytest

from rocksteady.kernels.core.clock import clock
from rocksteady.kernels.core.tables import (
    ALIKE,
    AT_REST,
    LIFT,
    LIFT_SLOPE,
    NONLINEAR_SEGMENT_COLUMNS,
    OVERTURNED,
    ROCKING,
    ROW_ANGLE,
    ROW_DURATION,
    ROW_EVENT,
    ROW_HALF_CYCLES,
    ROW_PHASE,
    ROW_SIDE,
    ROW_VELOCITY,
    UNDECIDED,
    March,
)
from rocksteady.kernels.core.tuples import Kept, Tables, Until
from rocksteady.kernels.march.march import march
from rocksteady.kernels.orbits.closed_form import symmetric_orbit, symmetry_breaking
from tests.every import every
from tests.kernels.tables import (
    NONE,
    Piece,
    Run,
    both_sides,
    harmonic,
    march_to,
    run,
    signs_hold,
    table,
)
from tests.strategies import sample_size

TWO_PI = 2.0 * math.pi


# ------------------------------------------------------------------------------- invariants

MIRRORS = [
    (2.0, 4.0, 0.8, 0.3),
    (6.0, 1.5, 0.9, 0.1),
    (1.0, 2.0, 0.5, 0.2),
    (3.0, 900.0, 0.7, 1e-3),
]


@every(("amplitude", "frequency", "restitution", "velocity"), MIRRORS)
@every("phase", [0.0, 0.7, 2.9])
def test_the_mirrored_march_is_the_same_to_the_last_bit(
    amplitude: float, frequency: float, restitution: float, velocity: float, phase: float
) -> None:
    segments, sides = harmonic(amplitude, frequency), both_sides(restitution)
    for side in (1, 0):
        rows = []
        for mirror in (1, -1):
            start = March(
                mirror * side,
                mirror * side * 0.05,
                mirror * side * velocity,
                0,
                0 if mirror > 0 else 1,
                phase,
                0,
                0,
            )
            stop = 200 if mirror > 0 else 201
            none = np.zeros((0, 8))
            status, end = march(
                Tables(segments, sides), start, Until(stop, phase, math.inf, 5000), Kept(none, NONE)
            )
            record = np.zeros((end.flights, 8))
            march(
                Tables(segments, sides),
                start,
                Until(stop, phase, math.inf, 5000),
                Kept(record, NONE),
            )
            rows.append(record)
            assert status in {ROCKING, AT_REST, OVERTURNED}
        one, other = rows
        assert len(one) > 0
        for column, factor in (
            (ROW_PHASE, 1.0),
            (ROW_SIDE, -1.0),
            (ROW_ANGLE, -1.0),
            (ROW_VELOCITY, -1.0),
            (ROW_DURATION, 1.0),
            (ROW_EVENT, 1.0),
        ):
            assert np.array_equal(one[:, column], factor * other[:, column])
        assert np.array_equal(one[:, ROW_HALF_CYCLES] + 1.0, other[:, ROW_HALF_CYCLES])


@pytest.mark.parametrize("nonlinear", [False, True])
def test_a_march_goes_on_where_another_has_stopped(nonlinear: bool) -> None:
    # Slopes with and without a sinusoid: what acts within a segment depends on the time since.
    pieces = [
        Piece(6.0, -0.1, 0.03, 0.0, 0.0, 0.0),
        Piece(8.0, 0.2, -0.015, 0.8, 3.0, 0.4),
        Piece(math.inf, 0.0, 0.0, 1.15, 2.5, 1.0),
    ]
    segments, sides = table(*pieces), both_sides(0.85)
    if nonlinear:
        segments = np.hstack(
            [segments[:, :ALIKE], np.zeros((3, NONLINEAR_SEGMENT_COLUMNS - ALIKE))]
        )
        segments[:, LIFT] = 0.1, -0.1, 0.0
        segments[:, LIFT_SLOPE] = -0.05, 0.03, 0.0
        sides = np.hstack([sides, np.full((2, 1), 0.3), np.full((2, 1), 1e-15)])
    none, stop = np.zeros((0, 8)), (12, 0.5)
    start = March(1, 0.6, 0.0, 0, 0, 0.0, 0, 0)
    tables, kept = Tables(segments, sides), Kept(none, NONE)
    whole, last = march(tables, start, Until(*stop, 1e-8, 10_000), kept)
    here, status, stops = start, UNDECIDED, 0
    while status == UNDECIDED:
        limit = here.flights + 1
        status, here = march(tables, here, Until(*stop, 1e-8, limit), kept)
        stops += 1
    assert stops > 10
    assert whole == ROCKING
    assert (status, here.side, here.impacts) == (whole, last.side, last.impacts)
    assert here.angle == pytest.approx(last.angle, abs=1e-11)
    assert here.velocity == pytest.approx(last.velocity, abs=1e-11)


@every("record", ["flight", "rest"])
@every("cut", [0.4321, 1.7, 2.718281828, 9.9])
def test_to_cut_a_segment_in_two_changes_nothing(record: str, cut: float) -> None:
    side, velocity = (1, 0.3) if record == "flight" else (0, 0.0)
    for amplitude, frequency, restitution in ((2.0, 4.0, 0.8), (1.3, 2.0, 0.4), (0.9, 7.0, 0.7)):
        sides = both_sides(restitution)
        whole = harmonic(amplitude, frequency, 0.6)
        first = Piece(cut, 0.0, 0.0, amplitude, frequency, 0.6)
        rest = Piece(math.inf, 0.0, 0.0, amplitude, frequency, 0.6 + frequency * cut)
        cycles = 25
        until = cycles * TWO_PI / frequency
        one = run(whole, sides, side=side, velocity=velocity, until=until)
        two = run(table(first, rest), sides, side=side, velocity=velocity, until=until)
        assert two.status == one.status
        assert two.end.side == one.end.side
        strong = [
            [case for case in ran.impacts() if abs(case[2]) > 1e-6 and case[0] < 0.999 * until]
            for ran in (one, two)
        ]
        assert len(strong[0]) == len(strong[1])
        for (time, before, after), (at, other, later) in zip(*strong, strict=True):
            assert before == other
            assert abs(time - at) <= 1e-13 * (1 + time) / min(1.0, abs(after))
            assert after == pytest.approx(later, rel=1e-9)


@every("offset", [-1e-9, -1e-15, 0.0, 1e-15, 1e-9])
@every("event", ["impact", "uplift"])
def test_a_cut_at_an_impact_or_at_uplift_changes_nothing(event: str, offset: float) -> None:
    amplitude, frequency = 2.0, 4.0
    side, velocity = (1, 0.3) if event == "impact" else (0, 0.0)
    sides, whole = both_sides(0.8), harmonic(amplitude, frequency, 0.1)
    one = run(whole, sides, side=side, velocity=velocity, half_cycles=40)
    at = one.rows[0, ROW_DURATION] * (1.0 + offset)
    two = run(
        table(
            Piece(at, 0.0, 0.0, amplitude, frequency, 0.1),
            Piece(math.inf, 0.0, 0.0, amplitude, frequency, 0.1 + frequency * at),
        ),
        sides,
        side=side,
        velocity=velocity,
        until=40 * math.pi / frequency,
    )
    assert signs_hold(two.rows)
    assert two.status == one.status
    # An impact at the cut may fall on either side of it, but it happens once.
    assert two.end.impacts == one.end.impacts
    assert two.end.angle == pytest.approx(one.end.angle, abs=1e-9)
    assert two.end.velocity == pytest.approx(one.end.velocity, abs=1e-9)


def lifts(ran: Run) -> list[tuple[float, float]]:
    """Return time and side of each start from rest."""
    times, found = ran.times(), []
    for i in range(1, len(ran.rows)):
        row, before = ran.rows[i], ran.rows[i - 1]
        still = row[ROW_SIDE] != 0.0 and row[ROW_ANGLE] == 0.0 and row[ROW_VELOCITY] == 0.0
        if still and before[ROW_SIDE] == 0.0:
            found.append((float(times[i]), float(row[ROW_SIDE])))
    return found


@pytest.mark.slow
def test_cuts_within_rounding_of_any_event_change_nothing() -> None:
    # A flight of some 1e-17 may be rounded into the floor: it must neither fall through it nor be
    # said to overturn there.
    rng = np.random.default_rng(17)
    compared = 0
    for _ in range(sample_size(600, 60)):
        amplitude = rng.choice([rng.uniform(1.0, 1.01), rng.uniform(1.0, 6.0)])
        frequency, phase = 10.0 ** rng.uniform(-1.0, 2.5), rng.uniform(0.0, 3.1)
        sides = both_sides(float(rng.uniform(0.1, 0.95)))
        side = int(rng.integers(-1, 2))
        velocity = side * rng.uniform(0.01, 0.5)
        whole = harmonic(amplitude, frequency, phase)
        limit = sample_size(3000, 300)
        one = run(whole, sides, side=side, velocity=velocity, half_cycles=12, limit=limit)
        if len(one.rows) < 2:
            continue
        event = float(one.times()[int(rng.integers(1, min(len(one.rows), 6)))])
        at = event * (1.0 + rng.choice([-1.0, 0.0, 1.0]) * 10.0 ** rng.uniform(-19.0, -12.0))
        if at <= 0.0:
            continue
        cut = table(
            Piece(at, 0.0, 0.0, amplitude, frequency, phase),
            Piece(math.inf, 0.0, 0.0, amplitude, frequency, phase + frequency * at),
        )
        until = 12 * math.pi / frequency
        two = run(cut, sides, side=side, velocity=velocity, until=until, limit=limit)
        assert signs_hold(two.rows), (amplitude, frequency, phase, at)
        # The impacts before the first weak one, from which on either may have come to rest.
        for (time, before, after), (other, same, speed) in list(
            zip(one.impacts(), two.impacts(), strict=False)
        )[:4]:
            if min(abs(after), abs(speed)) < 1e-3:
                break
            assert before == same
            assert abs(time - other) <= 1e-9 * (1 + time) / abs(after)
            compared += 1
        for lift, again in list(zip(lifts(one), lifts(two), strict=False))[:1]:
            if again[0] != pytest.approx(at, rel=1e-9):
                assert again == pytest.approx(lift, rel=1e-9)
    assert compared > sample_size(240, 20)


def test_a_jump_that_meets_an_impact_decides_the_side() -> None:
    # The block lies on its base as the impulse comes: where the sum of velocities points, it goes.
    first = run(table(Piece()), both_sides(0.5), side=1, velocity=0.3, limit=1)
    lands = float(first.rows[0, ROW_DURATION])
    for offset in (0.0, 1e-16, -1e-16):
        pieces = Piece(lands * (1.0 + offset)), Piece(jump=0.8)
        ran = run(table(*pieces), both_sides(0.5), side=1, velocity=0.3, limit=100_000)
        assert signs_hold(ran.rows)
        assert ran.status == AT_REST


def test_a_run_that_ends_on_an_impact_counts_it_once_at_most() -> None:
    rng = np.random.default_rng(3)
    ends = set()
    for _ in range(sample_size(1500, 40)):
        amplitude, frequency = rng.uniform(1.0, 4.0), rng.uniform(3.0, 12.0)
        restitution = rng.uniform(0.6, 0.99)
        orbit = symmetric_orbit(amplitude, frequency, restitution, 1, 1)
        if not (orbit.velocity > 0.0 and abs(orbit.trace) < 0.99 * (1.0 + restitution**2)):
            continue
        cycles = int(rng.integers(0, 12))
        ran = run(
            harmonic(amplitude, frequency, orbit.phase),
            both_sides(restitution),
            side=1,
            velocity=frequency * orbit.velocity,
            half_cycles=2 * cycles,
        )
        assert ran.status == ROCKING
        ends.add((ran.end.impacts - 2 * cycles, ran.end.side))
    assert ends <= {(0, 1), (-1, -1)}


# ------------------------------------------------------------------------------------ no drift


@pytest.mark.slow
@every(
    ("frequency", "restitution", "order", "share"),
    [
        (0.5, 0.9, 1, 0.5),
        (1.5, 0.8, 1, 0.4),
        (4.0, 0.8, 1, 0.5),
        (6.0, 0.8, 3, 0.6),
        (40.0, 0.9, 1, 0.02),
        (500.0, 0.7, 1, 0.01),
    ],
)
def test_a_million_cycles_do_not_drift(
    frequency: float, restitution: float, order: int, share: float
) -> None:
    d = (1.0 - restitution) / (1.0 + restitution)
    h = math.tanh(order * math.pi / (2.0 * frequency))
    least = (1.0 + frequency**2) * d * h * h / math.hypot(1.0, d * h * frequency)
    most = symmetry_breaking(frequency, restitution, order)
    amplitude = least + share * (most - least)
    orbit = symmetric_orbit(amplitude, frequency, restitution, order, 1)
    half, phase = clock(orbit.phase)
    impacts = sample_size(2_000_000, 200)
    end = march_to(
        harmonic(amplitude, frequency, phase),
        both_sides(restitution),
        impacts,
        frequency * orbit.velocity,
    )
    assert half == 0
    assert end.impacts == impacts
    assert end.half_cycles == impacts * order
    assert end.phase == pytest.approx(phase, abs=2e-13)
    assert end.velocity == pytest.approx(frequency * orbit.velocity, rel=1e-12)
