"""Reduction of large angles: the digits of 2/pi, and the angle that is left."""

import math

import flint
import numpy as np

from rocksteady.kernels.elementary._turns import LIMBS, PER_QUARTER_DIGITS, reduced_far


@flint.ctx.workprec(24 * LIMBS + 64)
def test_the_digits_of_two_over_pi() -> None:
    scaled = 2 / flint.arb.pi() * flint.arb(2) ** (24 * LIMBS)
    assert scaled.floor().unique_fmpz() == PER_QUARTER_DIGITS


@flint.ctx.workprec(1300)
def test_what_is_left_has_thirty_digits() -> None:
    rng = np.random.default_rng(8)
    angles = np.exp(rng.uniform(math.log(2e5), math.log(1e308), 2000))
    quarter = flint.arb.pi() / 2
    for angle in (*angles.tolist(), 6381956970095103.0 * 2.0**797):
        for sign in (1.0, -1.0):
            x, tail, n = reduced_far(sign * angle)
            turns = flint.arb(sign * angle) / quarter
            whole = (turns + 0.5).floor()
            left = (turns - whole) * quarter
            assert abs(x) <= 0.25 * math.pi + 1e-15
            assert abs(float((flint.arb(x) + flint.arb(tail) - left) / left)) < 1e-30
            count = whole.unique_fmpz()
            assert count is not None
            assert n == count % 4


def test_what_is_no_angle_leaves_none() -> None:
    for angle in (math.inf, -math.inf, math.nan):
        assert math.isnan(reduced_far(angle)[0])
