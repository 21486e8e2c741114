"""Control points against exact fractions; what their signs say against the roots of polynomials."""

from fractions import Fraction
from math import comb
from typing import Any

import numpy as np
import pytest
from numpy.polynomial import Polynomial
from numpy.typing import NDArray

from rocksteady.kernels.nonlinear._bernstein import (
    FALLS,
    NO_CHANGE,
    RISES,
    UNKNOWN,
    change_of_sign,
    control_points,
    differences,
    hull,
)
from rocksteady.kernels.nonlinear.series import HIGHEST, POINTS, TERMS, WORK_ROWS
from tests.every import every

Floats = NDArray[np.float64]


def space(given: Any) -> tuple[Floats, int]:
    coefficients = np.asarray(given, dtype=np.float64)
    work = np.full((WORK_ROWS, TERMS), 7.0)  # what another step has left there
    work[0, : len(coefficients)] = coefficients
    return work, len(coefficients) - 1


def exact_points(coefficients: Floats, step: float, dropped: int) -> list[Fraction]:
    """Values of the blossom: sum of a_i C(j, i)/C(N, i) in fractions."""
    scaled = [
        Fraction(float(c)) * Fraction(step) ** i for i, c in enumerate(coefficients[dropped:])
    ]
    return [
        sum(
            (a * Fraction(comb(j, i), comb(HIGHEST, i)) for i, a in enumerate(scaled[: j + 1])),
            Fraction(0),
        )
        for j in range(TERMS)
    ]


@every("seed", range(10))
@every("dropped", [0, 1, 2])
def test_control_points_are_those_of_fractions_within_what_is_stated(
    seed: int, dropped: int
) -> None:
    rng = np.random.default_rng(seed)
    coefficients = rng.normal(size=rng.integers(4, TERMS + 1)) * rng.uniform(0.3, 3.0) ** 3
    coefficients[:dropped] = 0.0
    step = float(rng.uniform(0.01, 3.0))
    work, degree = space(coefficients)
    doubt = control_points(work, degree, step, dropped)
    exact = exact_points(coefficients, step, dropped)
    off = [abs(float(Fraction(p) - e)) for p, e in zip(work[POINTS].tolist(), exact, strict=True)]
    assert 0.0 < max(off) < doubt
    # A bound that is not wide of the mark.
    assert doubt < 1e-13 * float(sum(map(abs, coefficients * step ** np.arange(degree + 1)))) / (
        step**dropped
    )


@every("seed", range(10))
def test_the_polynomial_and_its_derivatives_stay_within_their_points(seed: int) -> None:
    rng = np.random.default_rng(100 + seed)
    curve = Polynomial(rng.normal(size=12))
    step = float(rng.uniform(0.2, 1.5))
    work, degree = space(curve.coef)
    doubt = control_points(work, degree, step, 0)
    t = np.linspace(0.0, step, 2001)
    scale = 1.0
    for order in range(3):
        least, most = hull(work, TERMS - order)
        values = (curve.deriv(order) if order else curve)(t) * scale
        assert least - 4.0 * doubt <= values.min()
        assert values.max() <= most + 4.0 * doubt
        assert work[POINTS, 0] == pytest.approx(values[0], abs=4.0 * doubt)
        assert work[POINTS, TERMS - order - 1] == pytest.approx(values[-1], abs=4.0 * doubt)
        differences(work, TERMS - order)
        scale *= step / (HIGHEST - order)


def test_signs_say_how_many_roots_there_are_or_nothing() -> None:
    rng = np.random.default_rng(5)
    seen = dict.fromkeys((NO_CHANGE, RISES, FALLS, UNKNOWN), 0)
    for _ in range(2000):
        roots = rng.uniform(-1.5, 2.5, rng.integers(2, 6))
        curve = Polynomial.fromroots(roots) * rng.choice([-1.0, 1.0])
        work, degree = space(curve.coef)
        kind, place = change_of_sign(work, TERMS, control_points(work, degree, 1.0, 0))
        seen[kind] += 1
        inside = np.count_nonzero((roots > 0.0) & (roots < 1.0))
        if kind == NO_CHANGE:
            assert inside == 0
        elif kind in (RISES, FALLS):
            assert inside == 1
            assert (curve(0.0) < 0.0) == (kind == RISES)
            assert 0.0 < place < 1.0
    assert min(seen.values()) > 100


def test_what_rounding_may_have_turned_says_nothing() -> None:
    for coefficients in ([1.0, -1.0], [0.0, 1.0], [1.0, -2.0, 1.0 + 1e-16], [np.nan, 1.0]):
        work, degree = space(coefficients)
        assert change_of_sign(work, TERMS, control_points(work, degree, 1.0, 0))[0] == UNKNOWN
