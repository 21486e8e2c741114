"""Amplitudes that are tried next: known margins, and what is promised of every interval."""

from collections.abc import Callable

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.typing import NDArray

from rocksteady.dynamics.overturning._borders import next_amplitudes
from tests.every import every

Floats = NDArray[np.float64]
Margin = Callable[[Floats], Floats]


def rounds(margin: Margin, tried: list[float], closest: float) -> tuple[Floats, int]:
    """Close in on the borders from some amplitudes, and count those that it takes."""
    amplitude = np.array(tried)
    while True:
        falls = margin(amplitude) > 0.0
        where = np.flatnonzero(falls[1:] != falls[:-1])
        high = amplitude[where + 1]
        apart = high - amplitude[where] > np.maximum(4.0 * np.spacing(high), closest * high)
        if not apart.any():
            return amplitude[where + 1], len(amplitude) - len(tried)
        more = next_amplitudes(amplitude, margin(amplitude), falls, where[apart], closest)
        amplitude = np.sort(np.concatenate([amplitude, more]))


@every(
    ("margin", "border"),
    [
        (lambda a: a * a * a - 8.0, 2.0),
        (lambda a: np.log(a / 2.0), 2.0),
        (lambda a: 1.0 / a - 0.5, 2.0),
        (lambda a: np.sin(a - 2.0) * 1e-3, 2.0),
    ],
)
def test_a_smooth_margin_takes_few_amplitudes(margin: Margin, border: float) -> None:
    (found,), taken = rounds(margin, [1.9, 1.999, 2.0004, 2.1], 1e-12)
    assert found == pytest.approx(border, rel=1e-12)
    assert taken <= 8  # halving takes 30


def test_a_border_outside_two_close_amplitudes_is_found_by_their_line() -> None:
    (found,), taken = rounds(lambda a: a * a - 4.0, [1.0, 1.9999, 1.99991, 3.0], 1e-12)
    assert found == pytest.approx(2.0, rel=1e-12)
    assert taken <= 15


@every(
    "margin",
    [
        lambda a: np.where(a > 2.0, 1.0, -1.0),  # a jump
        lambda a: np.where(a > 2.0, 5.0 * (a - 2.0), np.cbrt(a - 2.0)),
        lambda a: np.where(a > 2.0, 1e200, a - 2.5),
    ],
)
def test_a_margin_that_is_not_smooth_is_halved_as_often_as_it_takes(margin: Margin) -> None:
    (found,), taken = rounds(margin, [1.0, 1.9, 2.2, 3.0], 1e-12)
    assert found == pytest.approx(2.0, rel=2e-12)
    assert taken <= 120


def test_rounding_makes_no_window_of_its_own() -> None:
    rng = np.random.default_rng(5)
    for _ in range(200):
        size, zero = 10.0 ** rng.uniform(-16.0, -13.0), rng.uniform(1.0, 20.0)

        def margin(a: Floats, size: float = size, zero: float = zero) -> Floats:
            # The same noise at the same amplitude.
            return a / zero - 1.0 + size * np.sin(1e17 * a)

        borders, _ = rounds(margin, [0.9 * zero, zero * (1 - 1e-5), zero * (1 + 1e-5), 30.0], 0.0)
        assert len(borders) == 1
        assert borders[0] == pytest.approx(zero, rel=4.0 * size + 1e-15)


@given(
    st.lists(st.floats(1.0, 20.0), min_size=2, max_size=12, unique=True),
    st.lists(st.floats(-1.0, 1.0), min_size=12, max_size=12),
    st.sampled_from([0.0, 1e-12, 1e-6]),
)
def test_every_interval_gets_one_or_more_within_itself(
    tried: list[float], margins: list[float], closest: float
) -> None:
    amplitude = np.sort(tried)
    margin = np.array(margins[: len(amplitude)])
    falls = margin > 0.0
    where = np.flatnonzero(np.diff(amplitude) > 4.0 * np.spacing(amplitude[1:]))
    more = next_amplitudes(amplitude, margin, falls, where, closest)
    assert (np.diff(more) > 0.0).all()
    assert not np.isin(more, amplitude).any()
    place = np.searchsorted(amplitude, more) - 1
    np.testing.assert_array_equal(np.unique(place), where)
    same = falls[place] == falls[place + 1]
    halves = 0.5 * (amplitude[place] + amplitude[place + 1])
    np.testing.assert_array_equal(more[same], halves[same])
