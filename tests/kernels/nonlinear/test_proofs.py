"""Proofs of overturning and of rest against balls, in which every inequality is itself proved."""

import math
from collections.abc import Iterator
from dataclasses import replace
from functools import cache
from typing import NamedTuple

import flint
import numpy as np
import pytest
from flint import arb
from numpy.typing import NDArray

from rocksteady.kernels.core.scatter import largest_restitution
from rocksteady.kernels.core.tables import (
    AMPLITUDE,
    CEILING,
    CONSTANT,
    FREQUENCY,
    LIFT,
    LIFT_CEILING,
    LIFT_SLOPE,
    NONLINEAR_SEGMENT_COLUMNS,
    PHASE,
    SLOPE,
)
from rocksteady.kernels.core.tuples import Tables
from rocksteady.kernels.nonlinear.drive import Drive
from rocksteady.kernels.nonlinear.proofs import (
    SteppedBounce,
    bounce_bounds,
    bounces_settle,
    falls_on_still_base,
    point_of_no_return,
    stepped_bounce,
)
from tests.kernels.nonlinear.balls import (
    BITS,
    Ball,
    Base,
    Bounce,
    bounce,
    chatter,
    natural_step,
    step_of,
)

Floats = NDArray[np.float64]
EPSILON = 2.0**-52


@pytest.fixture(autouse=True)
def _precision() -> Iterator[None]:
    with flint.ctx.workprec(BITS):
        yield


def logarithmic(rng: np.random.Generator, low: float, high: float) -> float:
    return float(np.exp(rng.uniform(math.log(low), math.log(high))))


def random_sides(rng: np.random.Generator) -> Floats:
    """Return two sides that have little in common: restitution, lean, rate, alpha, left out."""
    alpha = logarithmic(rng, 1e-3, 1.5)
    other = float(np.clip(alpha * logarithmic(rng, 0.2, 5.0), 1e-3, 1.5))
    rows = [
        [rng.uniform(0.1, 0.97), each / alpha, rate, each, 1e-15]
        for each, rate in ((alpha, 1.0), (other, logarithmic(rng, 0.3, 3.0)))
    ]
    return np.array(rows)


def fallen(alpha: float) -> Ball:
    """Return the y of a block that lies on its side."""
    return arb.pi() / (2 * arb(alpha))


# --------------------------------------------------------------------------- the point of no return


def bounded_segment(ceiling: float, lift_ceiling: float) -> Floats:
    segments = np.zeros((1, NONLINEAR_SEGMENT_COLUMNS))
    segments[0, CEILING], segments[0, LIFT_CEILING] = ceiling, lift_ceiling
    return segments


def drawn_bound(rng: np.random.Generator) -> tuple[Floats, int, float, float, float]:
    """Return sides, one of them, its point of no return, and what bounds |h| and |l|."""
    sides, side = random_sides(rng), int(rng.choice([-1, 1]))
    ceiling = rng.choice([0.0, rng.uniform(0.0, 20.0), logarithmic(rng, 1e-6, 20.0)])
    shaken = rng.choice([0.0, rng.uniform(0.0, 1.0), 1.0 - logarithmic(rng, 1e-12, 1.0)])
    point = point_of_no_return(bounded_segment(ceiling, shaken), 0, sides, side)
    return sides, side, point, float(ceiling), float(shaken)


def test_beyond_the_point_of_no_return_no_base_within_its_bounds_pulls_a_block_back() -> None:
    # y'' is linear in h and l: least at a corner, which is h = -H, l = -L.
    rng = np.random.default_rng(21)
    for _ in range(300):
        sides, side, point, ceiling, shaken = drawn_bound(rng)
        row = sides[0 if side > 0 else 1]
        h, alpha = arb(ceiling) / arb(row[1]), float(row[3])
        corners = [
            Base(alpha, constant=sign * h, lift=up * arb(shaken))
            for sign in (-1, 1)
            for up in (-1, 1)
        ]
        worst, zero = corners[0], arb(0)
        past = arb(point) * (1 + 8 * EPSILON)
        assert all(corner.acceleration(zero, past) > 0 for corner in corners)
        assert worst.acceleration(zero, arb(point) * (1 - 8 * EPSILON)) < 0
        # From there to the ground, in intervals that become shorter towards the point.
        end, last = fallen(alpha), past
        if not past < end:
            continue
        for k in reversed(range(70)):
            until = past + (end - past) / arb(2) ** k
            between = last.union(until)
            assert all(corner.acceleration(zero, between) > 0 for corner in corners)
            last = until


@pytest.mark.parametrize("side", [1, -1])
def test_where_the_base_may_fall_away_or_jump_there_is_no_point_of_no_return(side: int) -> None:
    rng = np.random.default_rng(22 + side)
    for _ in range(50):
        sides = random_sides(rng)
        alpha = float(sides[0 if side > 0 else 1, 3])
        ceiling = float(rng.uniform(0.01, 20.0))
        for shaken in (1.0, float(rng.uniform(1.0, 3.0))):
            segments = bounded_segment(ceiling, shaken)
            assert point_of_no_return(segments, 0, sides, side) == math.inf
            # Rightly: the base turns back a block that has all but fallen.
            pull = Base(alpha, constant=-ceiling, lift=-shaken)
            assert pull.acceleration(arb(0), fallen(alpha) * (1 - arb(1e-9))) < 0
        assert point_of_no_return(bounded_segment(math.inf, 0.0), 0, sides, side) == math.inf


def ends(base: Base, angle: Ball, velocity: Ball, low: Ball, high: Ball, longest: float) -> str:
    """Return which of two angles a motion is proved to pass, by steps, or that it is open."""
    time = arb(0)
    while time < longest:
        step = step_of(base, time, angle, velocity, natural_step(base, velocity))
        time += step.length
        angle, velocity = step.angle(step.length), step.velocity(step.length)
        if angle < low:
            return "back"
        if angle > high:
            return "falls"
    return "open"


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(6))
def test_motions_beyond_the_point_of_no_return_fall(seed: int) -> None:
    rng = np.random.default_rng(seed)
    alpha = logarithmic(rng, 1e-3, 1.0)
    ceiling, shaken = float(rng.uniform(0.1, 3.0)), float(rng.uniform(0.0, 0.8))
    sides = np.array([[0.9, 1.0, 1.0, alpha, 1e-15]] * 2)
    point = point_of_no_return(bounded_segment(ceiling, shaken), 0, sides, 1)
    steady = seed % 3 == 0
    base = Base(
        alpha,
        constant=-ceiling if steady else 0,
        amplitude=0 if steady else arb(ceiling),
        phase=-arb.pi() / 2,
        frequency=0 if steady else logarithmic(rng, 0.05, 30.0),
        lift=-arb(shaken),
    )
    high = min(fallen(alpha), arb(point) + 30, key=float)
    if not arb(point) * 1.001 < high:
        high = arb(point) * 1.01
    away = arb(point) * (1 + arb(1e-5))
    assert ends(base, away, arb(0), arb(point), high, 60.0) == "falls"
    if steady:
        near = arb(point) * (1 - arb(1e-5))
        assert ends(base, near, arb(0), arb(0), high, 60.0) == "back"


# -------------------------------------------------------------------------------- on a still base


def overturns(alpha: float, angle: float, velocity: float) -> bool:
    """Return whether a block overturns on a still base, from its energy in balls."""
    a, y, v = arb(alpha), arb(angle), arb(velocity)
    half_sine = (a * (1 - y) / 2).sin()
    excess = v * v / 2 - 2 * half_sine * half_sine / (a * a)  # over that of the upright block
    if y == 1:
        return bool(v > 0)
    if y < 1:
        return bool(v > 0 and excess > 0)
    return bool(v > 0 or excess < 0)


def drawn_angle(rng: np.random.Generator, alpha: float) -> float:
    lying = 0.5 * math.pi / alpha
    beside = 1.0 + float(rng.choice([-1.0, 1.0])) * logarithmic(rng, 1e-14, 0.5)
    return float(rng.choice([rng.uniform(0.0, 1.0), min(beside, lying), rng.uniform(1.0, lying)]))


def test_on_a_still_base_the_verdict_is_that_of_the_energy() -> None:
    rng = np.random.default_rng(23)
    falls = 0
    for _ in range(4000):
        alpha = logarithmic(rng, 1e-3, 1.5)
        angle = drawn_angle(rng, alpha)
        border = float(2 * (arb(alpha) * abs(1 - arb(angle)) / 2).sin() / arb(alpha))
        for off in (1e-12, 8.0 * EPSILON, float(rng.uniform(0.0, 2.0))):
            for sign in (-1.0, 1.0):
                for velocity in (border * (1.0 + sign * off), -border * (1.0 + sign * off)):
                    expected = overturns(alpha, angle, velocity)
                    falls += expected
                    assert falls_on_still_base(alpha, angle, velocity) == expected
    assert 20_000 < falls < 28_000


def test_upright_the_direction_decides() -> None:
    for alpha in (1e-3, 0.2, 1.5):
        assert not falls_on_still_base(alpha, 1.0, 0.0)
        assert falls_on_still_base(alpha, 1.0, 1e-300)
        assert not falls_on_still_base(alpha, 1.0, -1e-300)


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(8))
def test_motions_beside_the_border_go_where_the_verdict_says(seed: int) -> None:
    rng = np.random.default_rng(seed)
    alpha = logarithmic(rng, 1e-3, 1.0)
    below = seed % 2 == 0
    angle = float(rng.uniform(0.05, 0.95) if below else rng.uniform(1.05, 1.5))
    barrier = 2.0 * math.sin(0.5 * alpha * abs(1.0 - angle)) / alpha
    upper = arb(min(float(fallen(alpha)), 3.0))
    if angle >= float(upper):
        angle = 0.5 * (1.0 + float(upper))
    for off in (-1e-12, 1e-12):
        velocity = barrier * (1.0 + off) * (1.0 if below else -1.0)
        verdict = falls_on_still_base(alpha, angle, velocity)
        assert verdict == ((off > 0.0) == below)
        went = ends(Base(alpha), arb(angle), arb(velocity), arb(0), upper, 90.0)
        assert went == ("falls" if verdict else "back")


# ---------------------------------------------------------------------------------------- bounces


def as_base(drive: Drive, phase: float) -> Base:
    return Base(
        drive.alpha,
        drive.constant,
        drive.slope,
        drive.amplitude,
        phase,
        drive.frequency,
        drive.lift,
        drive.lift_slope,
    )


def drawn_bounces(
    seed: int, count: int
) -> Iterator[tuple[Drive, float, float, tuple[float, float, float], float]]:
    """Yield drives with phase, velocity of a bounce, bounds and window, where bounds exist."""
    rng = np.random.default_rng(seed)
    for _ in range(count):
        alpha = logarithmic(rng, 1e-3, 1.5)
        kind = rng.integers(0, 4)  # a sinusoid, straight lines, both, a still base
        swings, ramps = kind in {0, 2}, kind in {1, 2}
        drive = Drive(
            alpha,
            float(rng.uniform(-2.0, 0.5)) if ramps else 0.0,
            float(rng.normal(0.0, 3.0)) if ramps else 0.0,
            float(rng.choice([rng.uniform(0.0, 1.0), rng.uniform(0.0, 20.0)])) if swings else 0.0,
            logarithmic(rng, 0.05, 100.0) if swings else 0.0,
            float(rng.uniform(-0.8, 5.0)) if ramps else 0.0,
            float(rng.normal(0.0, 3.0)) if ramps else 0.0,
        )
        phase = float(rng.uniform(-0.5 * math.pi, 1.5 * math.pi))
        pull = -float(as_base(drive, phase).foot(arb(0)))
        if pull <= 0.0:
            continue
        velocity = pull * float(rng.choice([logarithmic(rng, 1e-6, 1.0), rng.uniform(0.0, 1.0)]))
        window = 2.5 * velocity / pull
        bounds = bounce_bounds(SteppedBounce(drive, phase, velocity, 1.0), window)
        if bounds[1] <= window:
            yield drive, phase, velocity, bounds, window


def largest(values: list[Ball]) -> Ball:
    """Return the largest absolute value, from above."""
    return arb(max(float(abs(value).upper()) for value in values)) * (1 + arb(1e-15))


def extremes(base: Base, span: Ball) -> tuple[Ball, Ball, Ball, Ball]:
    """Return max |r'|, max |k'|, the least -r and the largest k over a time, from outside."""
    alpha, pieces = arb(base.alpha), 64
    sine, cosine = alpha.sin() / alpha, alpha.cos()
    slopes, stiffenings, pulls, stiffnesses = [], [], [], []
    for k in range(pieces):
        time = (span * k / pieces).union(span * (k + 1) / pieces)
        turned = arb(base.phase) + arb(base.frequency) * time
        rate = arb(base.slope) + arb(base.amplitude) * arb(base.frequency) * turned.cos()
        up = arb(base.lift_slope)
        slopes.append(rate * cosine - up * sine)
        stiffenings.append(up * cosine + alpha * alpha * rate * sine)
        pulls.append(-base.foot(time).upper())
        stiffness = base.weight(time) * cosine + alpha * alpha * base.horizontal(time) * sine
        stiffnesses.append(stiffness.upper())
    return largest(slopes), largest(stiffenings), min(pulls), max(stiffnesses)


@cache
def flights() -> list[tuple[Base, Ball, tuple[float, float, float], Bounce]]:
    """Return bounces whose bounds are finite: base, velocity, bounds and what they do."""
    found = []
    with flint.ctx.workprec(BITS):
        for drive, phase, velocity, bounds, window in drawn_bounces(24, 280):
            base = as_base(drive, phase)
            made = bounce(base, arb(velocity), arb(window))
            assert made is not None, "where the bounds are finite it ends in the window"
            found.append((base, arb(velocity), bounds, made))
    return found


@pytest.mark.slow
def test_a_bounce_lasts_no_longer_and_lands_no_faster_than_its_bounds() -> None:
    closeness, shares, heights = [], [], []
    for _, velocity, (growth, lasts, top), made in flights():
        grown = (made.landing / velocity) ** 2
        # Where r and k are constant the growth is 1 and so is its bound.
        assert grown < arb(growth) * (1 + 4 * EPSILON)
        assert made.duration < arb(lasts) * (1 + 4 * EPSILON)
        assert made.height < arb(top) * (1 + 4 * EPSILON)
        closeness.append(float(made.duration) / lasts)
        heights.append(float(made.height) / top)
        if growth > 1.0:
            shares.append((float(grown) - 1.0) / (growth - 1.0))
    assert len(closeness) > 100
    # The bounds are none too wide: half of the durations come within a part in a hundred; of the
    # growth nearly a third is reached, as of the area under a parabola twice as high as the bounce.
    assert np.median(closeness) > 0.99
    assert np.median(heights) > 0.99
    assert 0.3 < max(shares) < 1.0


def test_the_statements_of_the_theory_about_a_bounce() -> None:
    # docs/theory/nonlinear.md, Rest: height, duration and drift, with the extremes of r and k over
    # the bounce itself.
    margin = 1 + arb(1e-25)
    drifts = []
    for base, velocity, _, made in flights():
        slope, stiffening, pull, stiffness = extremes(base, made.duration)
        most = max(arb(1), stiffness + pull * arb(base.alpha) ** 2 / 2)
        assert velocity**2 < pull
        assert pull**2 > most * velocity**2
        assert made.height < velocity**2 / pull
        assert made.duration < 2 * velocity / (pull**2 - most * velocity**2).sqrt() * margin
        change = made.landing**2 - velocity**2
        drift = 2 * (slope + stiffening) * made.height * made.duration
        assert change < drift + velocity**2 * arb(1e-25)
        if drift > 0:
            drifts.append(float(change / drift))
    assert 0.6 < max(drifts) < 1.0


def test_a_bounce_is_pulled_down_as_the_theory_says() -> None:
    # y'' <= -c + K y while 0 <= y <= 1, r <= -c and K >= max(1, k + c alpha^2/2).
    rng = np.random.default_rng(25)
    for _ in range(5000):
        alpha, angle = arb(logarithmic(rng, 1e-3, 1.5)), arb(float(rng.uniform(0.0, 1.0)))
        base = Base(
            alpha,
            constant=float(rng.uniform(-20.0, 20.0)),
            lift=float(rng.uniform(-0.99, 3.0)),
        )
        zero = arb(0)
        pull = -base.foot(zero)
        if not pull > 0:
            continue
        k = base.weight(zero) * alpha.cos() + alpha * base.horizontal(zero) * alpha.sin()
        least = pull * arb(float(rng.choice([1.0, rng.uniform(0.0, 1.0)])))
        most = max(arb(1), k + least * alpha**2 / 2)
        assert base.acceleration(zero, angle) < -least + most * angle + arb(1e-60)


# ---------------------------------------------------------------------------------------- chatter


class Chatter(NamedTuple):
    """A base motion in reference units, unlike sides, and the side of the first bounce."""

    base: Base
    sides: Floats
    side: int
    phase_here: float
    phase_there: float

    def ends(self, speed: float, span: float) -> bool:
        """Return the verdict of the kernel."""
        base = self.base
        segments = bounded_segment(math.inf, math.inf)
        segments[0, [CONSTANT, SLOPE, AMPLITUDE, FREQUENCY, PHASE, LIFT, LIFT_SLOPE]] = [
            *(base.constant, base.slope, base.amplitude, base.frequency),
            *(0.0, base.lift, base.lift_slope),
        ]
        tables = Tables(segments, self.sides)
        here = stepped_bounce(tables, 0, self.side, 0.0, speed, self.phase_here)
        there = stepped_bounce(tables, 0, -self.side, 0.0, speed, self.phase_there)
        return bounces_settle(largest_restitution(self.sides), span, here, there, math.inf)

    def fastest(self) -> float:
        """Return the largest speed of which the kernel proves that the bounces end."""
        low, high = 1e-12, 1e3
        if not self.ends(low, math.inf):
            return 0.0
        for _ in range(64):
            middle = math.sqrt(low * high)
            low, high = (middle, high) if self.ends(middle, math.inf) else (low, middle)
        return low

    def shortest(self, speed: float) -> float:
        """Return the shortest span within which the kernel proves that the bounces end."""
        low, high = 0.0, 1e3
        for _ in range(80):
            middle = 0.5 * (low + high)
            low, high = (low, middle) if self.ends(speed, middle) else (middle, high)
        return high


def drawn_chatter(rng: np.random.Generator) -> Chatter:
    """Return shaking stronger than uplift, at a time at which it is not."""
    sides, side = random_sides(rng), int(rng.choice([-1, 1]))
    sides[:, 0] = rng.uniform(0.1, 0.6, 2)
    phase = float(rng.uniform(-0.5 * math.pi, 1.5 * math.pi))
    other = phase + math.pi if phase < 0.5 * math.pi else phase - math.pi
    swings = rng.random() < 0.6
    base = Base(
        0.0,  # that of a side is in its row
        0.0 if swings else float(rng.uniform(-0.5, 0.5)),
        0.0 if swings else float(rng.choice([-1.0, 1.0])) * logarithmic(rng, 0.05, 20.0),
        float(rng.uniform(2.0, 20.0)) if swings else 0.0,
        phase if side > 0 else other,
        logarithmic(rng, 0.05, 100.0) if swings else 0.0,
        float(rng.choice([0.0, rng.uniform(-0.5, 0.5)])),
        float(rng.choice([0.0, rng.normal(0.0, 1.0)])),
    )
    return Chatter(base, sides, side, phase, other)


def rests(drawn: Chatter, speed: float, span: float) -> bool:
    """Return whether balls prove that the bounces end in a span, without an uplift before."""
    # The phase that the kernel is given from the side of the first bounce is the exact one.
    turned = arb(drawn.phase_here) if drawn.side > 0 else arb(drawn.phase_here) + arb.pi()
    end = chatter(replace(drawn.base, phase=turned), drawn.sides, drawn.side, arb(speed), span)
    return end is not None and bool(end < span)


def bordering(seed: int, count: int) -> Iterator[tuple[Chatter, float, float]]:
    """Yield chatter with the largest speed and the shortest span of which the kernel is sure."""
    rng = np.random.default_rng(seed)
    while count:
        drawn = drawn_chatter(rng)
        speed = drawn.fastest()
        if 0.0 < speed < 10.0:
            count -= 1
            yield drawn, speed, drawn.shortest(speed)


def test_the_verdict_on_chatter_is_the_same_in_the_units_of_any_reference() -> None:
    # Powers of two, so that nothing rounds: a reference of another slenderness and of another size.
    for drawn, speed, span in bordering(28, 20):
        base = drawn.base
        for lean, rate in ((4.0, 1.0), (1.0, 0.25), (0.5, 8.0)):
            shaken = replace(
                base,
                constant=base.constant * lean,
                slope=base.slope * lean * rate,
                amplitude=base.amplitude * lean,
                frequency=base.frequency * rate,
                lift_slope=base.lift_slope * rate,
            )
            sides = drawn.sides * np.array([1.0, lean, rate, 1.0, 1.0])
            other = drawn._replace(base=shaken, sides=sides)
            assert other.fastest() == pytest.approx(speed * lean * rate, rel=1e-12)
            assert other.shortest(speed * lean * rate) == pytest.approx(span / rate, rel=1e-12)


def test_chatter_that_is_proved_to_end_does_within_the_span_and_before_an_uplift() -> None:
    for drawn, speed, span in bordering(26, 20):
        assert drawn.ends(speed, span)
        assert not drawn.ends(speed, span * (1.0 - 1e-12))
        assert rests(drawn, speed, span), drawn


def test_the_proof_that_chatter_ends_is_none_too_weak() -> None:
    # It is sufficient, not necessary.  Half of the chatter no longer ends when it is 8 times as
    # fast, and half of it takes more than a third of the span.
    speeds, spans = [], []
    for drawn, speed, span in bordering(27, 4):
        speeds.append(next(k for k in range(1, 20) if not rests(drawn, 2.0**k * speed, 1e3)))
        spans.append(next(k for k in range(1, 20) if not rests(drawn, speed, span / 1.5**k)))
    assert np.median(speeds) <= 3.0
    assert np.median(spans) <= 3.0
