"""Curves of equations whose solutions are known: circles, folds, crossings, ends."""

import math
from collections import deque
from collections.abc import Callable
from dataclasses import dataclass
from itertools import islice

import numpy as np
import pytest
from numpy.typing import NDArray

from rocksteady.dynamics.continuation.chains.predictor_corrector import (
    ATTEMPTS,
    Curve,
    LostError,
    Spot,
    StalledError,
    gradient,
    null_vector,
)
from tests.every import every

Floats = NDArray[np.float64]


@dataclass(frozen=True)
class Plane:
    """One equation in two unknowns."""

    errors: Floats
    slopes: Floats
    place: Floats


def curve_of(
    value: Callable[[float, float], float],
    slopes: Callable[[float, float], tuple[float, float]],
    *,
    step: float = 0.05,
) -> Curve[Plane]:
    def evaluate(place: Floats) -> Plane | None:
        x, y = place.tolist()
        if max(abs(x), abs(y)) > 10.0:
            return None
        return Plane(np.array([value(x, y)]), np.array([slopes(x, y)]), place)

    return Curve(evaluate=evaluate, largest_step=step)


CIRCLE = curve_of(lambda x, y: x * x + y * y - 1.0, lambda x, y: (2.0 * x, 2.0 * y))


def begun(curve: Curve[Plane], place: tuple[float, float], to: tuple[float, float]) -> Spot[Plane]:
    spot = curve.start(np.array(place), np.array(to))
    assert spot is not None
    return spot


def test_a_circle_is_followed_around_its_turns() -> None:
    begin = begun(CIRCLE, (1.01, 0.0), (0.0, 1.0))
    assert begin.place == pytest.approx([1.0, 0.0], abs=1e-15)
    spots = list(islice(CIRCLE.follow(begin), 300))
    for spot in spots:
        assert np.hypot(*spot.place) == pytest.approx(1.0, abs=1e-14)
        assert float(spot.tangent @ spot.place) == pytest.approx(0.0, abs=1e-14)
        assert float(spot.tangent @ [-spot.place[1], spot.place[0]]) == pytest.approx(1.0)
    angles = np.unwrap([math.atan2(*spot.place[::-1]) for spot in spots])
    assert (np.diff(angles) > 0.0).all()
    assert angles[-1] > 2.0 * math.pi
    # In a step the arclength is that of the tangent: the circle's own is a little longer.
    lengths = np.diff([spot.arclength for spot in spots])
    assert lengths.max() <= 0.05
    assert np.diff(angles) == pytest.approx(np.arctan(lengths / np.sqrt(1 - lengths**2)), rel=1e-2)


def test_the_other_direction_is_the_other_way_round() -> None:
    begin = begun(CIRCLE, (1.0, 0.0), (0.0, -1.0))
    (spot,) = islice(CIRCLE.follow(begin), 1)
    assert spot.place[1] < 0.0


def test_an_event_between_two_points_is_found_to_rounding() -> None:
    begin = begun(CIRCLE, (1.0, 0.0), (0.0, 1.0))
    before = begin
    for after in islice(CIRCLE.follow(begin), 40):
        if before.place[1] < 0.6 <= after.place[1]:
            spot = CIRCLE.locate(before, after, lambda plane: float(plane.place[1]) - 0.6)
            assert spot.place == pytest.approx([0.8, 0.6], abs=1e-15)
            assert before.arclength < spot.arclength < after.arclength
            break
        before = after
    else:
        pytest.fail("the curve never came there")


def height_over(level: float) -> Callable[[Plane], float]:
    return lambda at: float(at.place[1]) - level


def test_the_nearest_event_on_either_side_is_found() -> None:
    spot = begun(CIRCLE, (0.8, 0.6), (0.0, 1.0))
    for level in (0.601, 0.599, 0.6 + 1e-7):
        found = CIRCLE.locate_near(spot, height_over(level), 0.05)
        assert found is not None
        assert found.place[1] == pytest.approx(level, abs=1e-15)
    assert CIRCLE.locate_near(spot, height_over(0.9), 0.05) is None
    assert CIRCLE.locate_near(spot, height_over(float(spot.place[1])), 0.05) is spot


def test_a_crossing_is_passed_on_the_own_curve() -> None:
    # x (y - x^2) = 0: a parabola and a line that cross in the origin.
    curve = curve_of(lambda x, y: x * (y - x * x), lambda x, y: (y - 3.0 * x * x, x))
    begin = begun(curve, (-0.5, 0.25), (1.0, 0.0))
    for spot in curve.follow(begin):
        assert spot.place[1] == pytest.approx(spot.place[0] ** 2, abs=1e-12)
        if spot.place[0] > 0.5:
            break
    else:
        pytest.fail("the curve was lost at the crossing")
    line = begun(curve, (0.0, -0.5), (0.0, 1.0))
    for spot in curve.follow(line):
        assert spot.place[0] == pytest.approx(0.0, abs=1e-12)
        if spot.place[1] > 0.5:
            break
    else:
        pytest.fail("the line was lost at the crossing")


@every("step", [0.2, 0.05, 0.01])
def test_curves_that_all_but_cross_are_not_exchanged(step: float) -> None:
    # The branches of x y = c: each turns the corner, however long the steps towards it.
    for c in (1e-5, -1e-5):

        def value(x: float, y: float, c: float = c) -> float:
            return x * y - c

        curve = curve_of(value, lambda x, y: (y, x), step=step)
        begin = begun(curve, (-1.0, -c), (1.0, 0.0))
        for spot in islice(curve.follow(begin), 2000):
            assert spot.place[0] < 0.0
            if abs(spot.place[1]) > 1.0:
                assert math.copysign(1.0, spot.place[1]) == math.copysign(1.0, -c)
                break
        else:
            pytest.fail("the curve was lost at the corner")


def test_an_event_in_a_crossing_is_lost_with_a_name() -> None:
    curve = curve_of(lambda x, y: x * (y - x * x), lambda x, y: (y - 3.0 * x * x, x))
    before, after = (begun(curve, (x, x * x), (1.0, 0.0)) for x in (-0.01, 0.012))
    apart = float(np.hypot(*(after.place - before.place)))
    later = Spot(place=after.place, tangent=after.tangent, solution=after.solution, arclength=apart)
    try:
        spot = curve.locate(before, later, lambda at: float(at.place[0]))
    except LostError:
        return
    assert abs(spot.place[0]) < 1e-5  # next to it no point can be corrected


def spiral(x: float, y: float) -> float:
    turn = 20.0 * math.log(math.hypot(x, y))
    return y * math.cos(turn) - x * math.sin(turn)


def spiral_slopes(x: float, y: float) -> tuple[float, float]:
    square = x * x + y * y
    turn = 10.0 * math.log(square)
    along = 20.0 * (y * math.sin(turn) + x * math.cos(turn)) / square
    return -math.sin(turn) - along * x, math.cos(turn) - along * y


def test_a_curve_that_gets_nowhere_stalls_with_a_name() -> None:
    # Without end to its turns, each a little smaller than the one before.
    curve = curve_of(spiral, spiral_slopes)
    begin = begun(curve, (1.0, 0.0), (-0.05, -1.0))
    spots: list[Spot[Plane]] = []
    with pytest.raises(StalledError):
        deque(map(spots.append, curve.follow(begin)))
    last = spots[-1].arclength
    assert last - spots[-ATTEMPTS].arclength < 2.0 * curve.largest_step
    assert np.hypot(*spots[-1].place) > 1e-4
    assert len(spots) < 3000


def test_short_steps_that_get_somewhere_do_not_stall() -> None:
    curve = curve_of(lambda x, y: y - x, lambda *_: (-1.0, 1.0), step=1e-6)
    spots = list(islice(curve.follow(begun(curve, (0.0, 0.0), (1.0, 1.0))), 1000))
    assert len(spots) == 1000


def test_a_curve_that_leaves_its_domain_ends() -> None:
    curve = curve_of(lambda x, y: y - x, lambda *_: (-1.0, 1.0), step=0.5)
    spots = list(curve.follow(begun(curve, (9.0, 9.0), (1.0, 0.0))))
    assert spots
    assert spots[-1].place[0] == pytest.approx(10.0, abs=1e-7)


def test_where_there_is_no_solution_there_is_no_start() -> None:
    curve = curve_of(lambda x, _: x * x + 1.0, lambda x, _: (2.0 * x, 0.0))
    assert curve.start(np.array([0.3, 0.0]), np.array([0.0, 1.0])) is None
    assert curve.start(np.array([0.0, 0.0]), np.array([0.0, 1.0])) is None
    assert CIRCLE.start(np.array([20.0, 0.0]), np.array([0.0, 1.0])) is None
    # Across a direction along which the equation changes there is no plane.
    assert CIRCLE.start(np.array([1.0, 0.0]), np.array([1.0, 0.0])) is None


def test_a_gradient_is_that_of_the_function() -> None:
    found = gradient(lambda x: float(x[0] ** 2 * math.sin(x[1])), np.array([1.3, 0.4]))
    exact = [2.6 * math.sin(0.4), 1.69 * math.cos(0.4)]
    assert found == pytest.approx(exact, rel=1e-8)
    assert np.isnan(gradient(lambda _: math.nan, np.zeros(2))).all()


@every("size", range(1, 7))
def test_the_vector_that_a_matrix_maps_to_nearly_nothing_has_one_sign(size: int) -> None:
    """Whatever turns or scales the rows, or their last digits, it is the same vector."""
    rng = np.random.default_rng(size)
    for _ in range(20):
        wanted = rng.normal(size=size + 1)
        wanted *= np.sign(wanted[np.abs(wanted) >= 0.5 * np.abs(wanted).max()][0])
        wanted /= np.linalg.norm(wanted)
        rows = rng.normal(size=(size, size + 1))
        matrix = rows - np.outer(rows @ wanted, wanted)
        turned = np.linalg.qr(rng.normal(size=(size, size)))[0] @ matrix
        for each in (matrix, -3.0 * matrix, turned, matrix + 1e-13 * rng.normal(size=rows.shape)):
            np.testing.assert_allclose(null_vector(each), wanted, atol=1e-8)


@every("sizes", [(0.5, 0.5), (0.499, -0.8), (-0.51, 1.0), (-1.0, 0.3), (0.0, 1.0)])
def test_the_first_large_component_is_positive(sizes: tuple[float, float]) -> None:
    x, y = sizes
    first, second = null_vector(np.array([[-y, x]]))
    assert first * y == pytest.approx(second * x)
    assert (first if abs(x) >= 0.5 * abs(y) else second) > 0.0
