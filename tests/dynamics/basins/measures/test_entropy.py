"""Basin entropy: by hand, and as the definition written out over every box."""

import math
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from rocksteady import DimensionlessBlock, Harmonic, compute_basins, compute_erosion
from rocksteady.basins import BasinEntropies, compute_basin_entropy
from rocksteady.errors import InputError
from tests.every import every


def test_four_boxes_by_hand() -> None:
    # Whole, 3 of 4, 2 of 4 and one of each of four basins.
    labels = [[7, 7, 1, 1], [7, 7, 1, 2], [1, 1, 1, 2], [2, 2, 7, 9]]
    found = compute_basin_entropy(labels, 2)
    three = -0.75 * math.log(0.75) - 0.25 * math.log(0.25)
    expected = np.array([[0.0, three], [math.log(2.0), math.log(4.0)]])
    np.testing.assert_allclose(found.box_entropy, expected, rtol=1e-15)
    assert found.entropy == pytest.approx(expected.sum() / 4.0, rel=1e-15)
    assert found.boundary_entropy == pytest.approx(expected.sum() / 3.0, rel=1e-15)
    assert (found.boxes, found.boundary_boxes, found.basins) == (4, 3, 4)
    # S_bb is above ln 2, of three boxes; of 27 alike it decides.
    assert not found.fractal
    assert "not identified: too few boundary boxes" in found.summary().replace("\n", " ")
    assert compute_basin_entropy(np.tile(labels, (3, 3)), 2).fractal
    assert found.largest == math.log(4.0)


def slow(labels: Any, box: int) -> tuple[float, float]:
    """Both entropies, box after box, as Attractors.jl computes them."""
    total, mixed, boxes = 0.0, 0, 0
    for first in np.ndindex(*(many // box for many in labels.shape)):
        part = labels[tuple(slice(k * box, (k + 1) * box) for k in first)].ravel().tolist()
        entropy = -sum(
            part.count(v) / len(part) * math.log(part.count(v) / len(part)) for v in set(part)
        )
        total, mixed, boxes = total + entropy, mixed + (len(set(part)) > 1), boxes + 1
    return total / boxes, total / mixed if mixed else math.nan


@given(
    labels=st.sampled_from([(12,), (6, 12), (6, 6, 6)]).flatmap(
        lambda shape: arrays(np.int64, shape, elements=st.integers(-1, 3))
    ),
    box=st.sampled_from([1, 2, 3, 6]),
)
def test_any_labels_in_any_number_of_dimensions(labels: Any, box: int) -> None:
    found = compute_basin_entropy(labels, box)
    both = (found.entropy, found.boundary_entropy)
    assert both == pytest.approx(slow(labels, box), abs=1e-12, nan_ok=True)
    assert 0.0 <= found.entropy <= found.largest + 1e-12
    renamed = compute_basin_entropy(10 - labels, box)
    np.testing.assert_allclose(renamed.box_entropy, found.box_entropy, atol=1e-15)


def test_labels_at_random_reach_the_largest_entropy() -> None:
    labels = np.random.default_rng(1).integers(0, 3, (400, 400))
    found = compute_basin_entropy(labels, 20)
    # A sample of N of m equal shares has ln m - (m - 1)/2N on average.
    assert found.entropy == pytest.approx(math.log(3.0) - 2.0 / 800.0, abs=3e-4)
    assert found.fractal


def test_one_basin_has_no_boundary() -> None:
    found = compute_basin_entropy(np.zeros((20, 20), dtype=np.int64))
    assert (found.entropy, found.boundary_boxes, found.fractal) == (0.0, 0, False)
    assert math.isnan(found.boundary_entropy)
    assert "no boundary" in found.summary()


@every(("shape", "side"), [((40, 60), 20), ((108, 144), 18), ((6, 10), 2)])
def test_boxes_are_by_default_the_largest_that_divide(shape: tuple[int, int], side: int) -> None:
    found = compute_basin_entropy(np.zeros(shape, dtype=np.int64))
    assert found.box == (side, side)


def test_boxes_of_unequal_sides_and_a_safe_basin() -> None:
    window = np.linspace(-1.0, 1.0, 20)
    block, motion = DimensionlessBlock(restitution=0.9), Harmonic(amplitude=1.0, frequency_ratio=2)
    safe = compute_erosion(block, motion, [0.5], angles=window, velocities=window).safe[0]
    found = compute_basin_entropy(safe, (4, 5))
    turned = compute_basin_entropy(safe.T, (5, 4))
    assert found.box_entropy.shape == (5, 4)
    np.testing.assert_array_equal(found.box_entropy, turned.box_entropy.T)
    basins = compute_basins(block, motion, angles=window, velocities=window)
    assert basins.entropy(5).entropy == compute_basin_entropy(basins.label, 5).entropy


@every(
    ("labels", "box", "says"),
    [
        ([], 1, "not empty"),
        (3, 1, "one dimension"),
        ([[0.5, 1.0]], 1, "integers"),
        ([[0, 1], [1]], 1, "integers"),
        (np.zeros((6, 9), dtype=int), 2, "give 3"),
        (np.zeros((6, 7), dtype=int), 2, "100 x 100"),
        (np.zeros((6, 6), dtype=int), 0, "whole number"),
        (np.zeros((6, 6), dtype=int), (2, 2, 2), "each of 2"),
    ],
)
def test_what_has_no_entropy_is_refused(labels: Any, box: Any, says: str) -> None:
    with pytest.raises(InputError, match=says):
        compute_basin_entropy(labels, box)


def test_entropies_over_a_parameter_are_those_of_each_value() -> None:
    parts = tuple(compute_basin_entropy([[0, 0, 1, k]], (1, 2)) for k in (1, 2))
    found = BasinEntropies(parameter="amplitude", values=np.array([1.0, 2.0]), entropies=parts)
    np.testing.assert_allclose(found.entropy, [0.0, 0.5 * math.log(2.0)], rtol=1e-15)
    assert np.isnan(found.boundary_entropy[0])
    assert found.to_dataframe()["amplitude"].tolist() == [1.0, 2.0]
    assert "—" in found.summary()
