"""Flights between impacts, against the closed form (7, 8) in 40 digits of mpmath."""

import mpmath as mp
from flint import arb

from rocksteady.certify.proofs._balls import hull, precision
from rocksteady.certify.proofs._flight import (
    Arc,
    Phase,
    Shaking,
    factors,
    landing,
    liftoff,
    row,
    stays_above,
)

CASE: dict[str, tuple[str, ...]] = {
    "amplitude": ("2",),
    "frequency_ratio": ("2",),
    "restitution": ("0.8",),
}


def mismatch(x: mp.mpf, y: mp.mpf, z: mp.mpf) -> mp.mpf:
    """(restitution V - w)/beta at y, from the coefficients of (7, 8) of both flights."""
    beta, ratio, loss = mp.mpf(2) / 5, 2, mp.mpf("0.8")

    def speeds(p: mp.mpf, q: mp.mpf) -> tuple[mp.mpf, mp.mpf]:
        t = (q - p + mp.pi) / ratio
        b = beta * mp.sin(p) - 1
        # y(t) = 0 decides a+, and w = a+ - beta Omega cos(phase)
        a = -(b * mp.cosh(t) + 1 - beta * mp.sin(p + ratio * t)) / mp.sinh(t)
        end = a * mp.cosh(t) + b * mp.sinh(t) - beta * ratio * mp.cos(p + ratio * t)
        return a - beta * ratio * mp.cos(p), -end

    return (loss * speeds(x, y)[1] - speeds(y, z)[0]) / beta


def test_the_row_of_an_impact_is_that_of_the_closed_form_and_its_slopes() -> None:
    with mp.workdps(40), precision(128):
        shaking = Shaking.of(CASE)
        points = [mp.mpf("2.8"), mp.mpf("2.9"), mp.mpf("2.75")]
        balls = [arb(str(x)) for x in points]
        sines = [Phase(*x.sin_cos()) for x in balls]
        flights = [factors((-shaking.duration(balls[k], balls[k + 1], 1)).exp()) for k in (0, 1)]
        found = row(shaking, sines, *flights)
        exactly = arb(mp.nstr(mismatch(*points), 38))
        assert abs(found.mismatch - exactly) < arb("1e-33")
        for k, slope in enumerate((found.before, found.at, found.after)):
            step = mp.mpf(10) ** -12
            moved = [[x + (j == k) * s * step for j, x in enumerate(points)] for s in (1, -1)]
            by_difference = (mismatch(*moved[0]) - mismatch(*moved[1])) / (2 * step)
            assert abs(float(slope.mid()) - float(by_difference)) < 1e-13


def test_speeds_are_those_at_both_ends() -> None:
    with precision(64):
        shaking = Shaking.of(CASE)
        x = arb("2.8783881802574120819")
        sine, flight = Phase(*x.sin_cos()), factors((-shaking.duration(x, x, 1)).exp())
        speed = liftoff(shaking, sine, sine, flight)
        assert abs(float(speed.mid()) - 1.2695494850181553) < 1e-15
        lost = shaking.restitution * landing(shaking, sine, sine, flight)
        assert abs(speed - lost) < 1e-15


def test_a_flight_is_above_the_floor_below_it_or_undecided() -> None:
    with precision(64):
        shaking = Shaking.of(CASE | {"amplitude": ("2.4",)})
        good = arb("2.8913")
        assert stays_above(shaking, Arc(good, good, shaking.duration(good, good, 1))) is True
        bad = arb("0.1")
        assert stays_above(shaking, Arc(bad, bad, shaking.duration(bad, bad, 3))) is False
        wide = hull(0, 3)
        assert stays_above(shaking, Arc(wide, wide, shaking.duration(good, good, 1)), 3) is None
