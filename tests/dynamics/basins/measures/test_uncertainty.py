"""Uncertainty exponent: boundaries of known dimension, and counts written out."""

import math
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from rocksteady.basins import compute_uncertainty_exponent
from rocksteady.errors import InputError
from tests.dynamics.basins.measures.labelled_sets import cantor, disc, newton, tilted_plane
from tests.every import every

CANTOR = math.log(2.0) / math.log(3.0)


def test_boxes_of_a_cantor_set_have_its_dimension_to_the_last_digits() -> None:
    found = compute_uncertainty_exponent(cantor(9), [3**k for k in range(1, 8)], by="boxes")
    assert found.uncertain.tolist() == [2 ** (9 - k) for k in range(1, 8)]
    assert found.dimension == pytest.approx(CANTOR, abs=1e-12)
    assert found.exponent == pytest.approx(1.0 - CANTOR, abs=1e-12)


def test_states_near_a_cantor_set_have_its_exponent() -> None:
    found = compute_uncertainty_exponent(cantor(11), [3**k for k in range(1, 9)])
    low, high = found.interval(0.95)
    assert low < 1.0 - CANTOR < high
    assert found.standard_error < 0.01


def test_a_cantor_set_of_lines_in_the_plane() -> None:
    plane = np.broadcast_to(cantor(6), (120, 729))
    found = compute_uncertainty_exponent(plane, [1, 3, 9, 27])
    assert found.dimension == pytest.approx(1.0 + CANTOR, abs=0.05)
    along = compute_uncertainty_exponent(cantor(6), [1, 3, 9, 27])
    assert found.exponent == pytest.approx(along.exponent, abs=1e-12)


@pytest.mark.parametrize("labels", [tilted_plane(400), disc(400)])
def test_a_smooth_boundary_has_exponent_1(labels: Any) -> None:
    found = compute_uncertainty_exponent(labels)
    assert found.exponent == pytest.approx(1.0, abs=2e-3)
    assert found.dimension == pytest.approx(1.0, abs=2e-3)
    low, high = found.interval()
    assert high - low < 0.01


def test_boxes_of_few_states_raise_the_exponent_of_a_line() -> None:
    # A straight boundary meets N boxes, but of a box of e states it misses 1/e.
    labels = np.repeat([[0] * 360 + [1] * 360], 720, axis=0)
    sizes = [7, 11, 13, 17, 19, 23]  # the boundary falls inside a box of each
    found = compute_uncertainty_exponent(labels, sizes, by="boxes")
    assert found.uncertain.tolist() == [720 // size for size in sizes]
    assert found.exponent == pytest.approx(1.0, abs=0.02)
    small = compute_uncertainty_exponent(disc(400), by="boxes")
    assert small.exponent > 1.1
    assert "raises the exponent" in small.summary()


def test_the_roots_of_newtons_method_have_a_fractal_boundary() -> None:
    # The Julia set of z^3 - 1 has the box dimension 1.42 (Nusse and Yorke; Daza et al. 2016).
    found = compute_uncertainty_exponent(newton(600))
    assert found.dimension == pytest.approx(1.42, abs=0.04)
    assert found.r_squared > 0.995


def uncertain_states(labels: Any, size: int, margin: int) -> int:
    """States whose label changes a number of cells away, one after another."""
    count = 0
    for at in np.ndindex(*(many - 2 * margin for many in labels.shape)):
        place = np.array(at) + margin
        moved = [
            labels[tuple(place + step * size * np.eye(labels.ndim, dtype=int)[axis])]
            for axis in range(labels.ndim)
            for step in (-1, 1)
        ]
        count += any(other != labels[tuple(place)] for other in moved)
    return count


@given(labels=arrays(np.int64, (9, 12), elements=st.integers(0, 2)))
def test_counts_are_those_of_the_definitions(labels: Any) -> None:
    found = compute_uncertainty_exponent(labels, [3, 1, 2])
    assert found.size.tolist() == [1, 2, 3]
    assert found.uncertain.tolist() == [uncertain_states(labels, size, 3) for size in (1, 2, 3)]
    assert found.total.tolist() == [18, 18, 18]
    boxes = compute_uncertainty_exponent(labels, [2, 3, 5], by="boxes")
    assert boxes.total.tolist() == [24, 12, 2]
    for size, uncertain in zip((2, 3, 5), boxes.uncertain, strict=True):
        whole = [(9 // size), (12 // size)]
        mixed = [
            len(np.unique(labels[a * size : (a + 1) * size, b * size : (b + 1) * size])) > 1
            for a, b in np.ndindex(*whole)
        ]
        assert uncertain == sum(mixed)


def test_the_line_is_that_of_scipy() -> None:
    from scipy.stats import linregress

    found = compute_uncertainty_exponent(newton(200))
    line = linregress(np.log(found.size), np.log(found.share))
    assert found.exponent == pytest.approx(line.slope, rel=1e-12)
    assert found.standard_error == pytest.approx(line.stderr, rel=1e-9)
    assert found.r_squared == pytest.approx(line.rvalue**2, rel=1e-12)


def test_without_a_boundary_there_is_no_exponent() -> None:
    found = compute_uncertainty_exponent(np.zeros((80, 80), dtype=np.int64))
    assert math.isnan(found.exponent)
    assert all(map(math.isnan, found.interval()))
    assert "not identified" in found.summary()


def test_two_sizes_are_too_few_for_an_exponent() -> None:
    """A line through two points has no error: whatever they are, it fits them."""
    labels = newton(200)
    two = compute_uncertainty_exponent(labels, [1, 4])
    assert math.isnan(two.exponent)
    assert math.isnan(two.dimension)
    assert all(map(math.isnan, two.interval()))
    assert "too few for an exponent" in two.summary().replace("\n", " ")
    low, high = compute_uncertainty_exponent(labels, [1, 2, 4]).interval()
    assert low < high


@every(
    ("labels", "sizes", "by", "says"),
    [
        (np.zeros((20, 20), dtype=int), None, "states", "20 x 20 states"),
        (np.zeros((20, 20), dtype=int), [1], "states", "two different"),
        (np.zeros((20, 20), dtype=int), [1, 10], "states", "whole number"),
        (np.zeros((20, 20), dtype=int), [1, 2], "boxes", "whole number"),
        (np.zeros((20, 20), dtype=int), [2, 3.5], "boxes", "whole number"),
        (np.zeros((20, 20), dtype=int), [2, 3], "balls", "states"),
        (np.zeros((20, 20)), [2, 3], "states", "integers"),
    ],
)
def test_what_has_no_line_is_refused(labels: Any, sizes: Any, by: Any, says: str) -> None:
    with pytest.raises(InputError, match=says):
        compute_uncertainty_exponent(labels, sizes, by=by)
