"""Matching of sets of states: distances by hand, and the greedy rule of Attractors.jl."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from rocksteady import DimensionlessBlock, Harmonic, find_orbits
from rocksteady.basins import MatchingOptions
from rocksteady.dynamics.basins.over.matching import SAMPLES, apart, courses, matched
from rocksteady.errors import InputError
from rocksteady.orbits import Orbit
from tests.every import every


def flat(*values: float) -> np.ndarray:
    """States whose angle is constant over a period."""
    return np.repeat(np.array(values)[:, None], SAMPLES, axis=1)


def test_three_distances_of_two_sets_by_hand() -> None:
    one, other = flat(0.0, 1.0), flat(0.1, 0.9, 2.5)
    assert apart(MatchingOptions(), one, other) == pytest.approx(1.5)
    assert apart(MatchingOptions(distance="nearest"), one, other) == pytest.approx(0.1)
    assert apart(MatchingOptions(distance="centroid"), one, other) == pytest.approx(3.5 / 3.0 - 0.5)


@given(
    one=arrays(np.float64, (3, SAMPLES), elements=st.floats(-1.0, 1.0)),
    other=arrays(np.float64, (2, SAMPLES), elements=st.floats(-1.0, 1.0)),
    how=st.sampled_from(["hausdorff", "centroid", "nearest"]),
)
def test_a_distance_is_symmetric_and_that_of_scipy(
    one: np.ndarray, other: np.ndarray, how: str
) -> None:
    from scipy.spatial.distance import cdist

    matching = MatchingOptions(distance=how)  # type: ignore[arg-type]
    assert apart(matching, one, other) == pytest.approx(apart(matching, other, one), abs=1e-12)
    assert apart(matching, one, one[::-1]) == pytest.approx(0.0, abs=1e-12)
    away = cdist(one, other) / math.sqrt(SAMPLES)
    expected = {
        "hausdorff": max(away.min(axis=0).max(), away.min(axis=1).max()),
        "nearest": away.min(),
        "centroid": np.linalg.norm(one.mean(axis=0) - other.mean(axis=0)) / math.sqrt(SAMPLES),
    }[how]
    assert apart(matching, one, other) == pytest.approx(expected, abs=1e-12)


def test_the_closest_pair_goes_first() -> None:
    # Pairs 0.1 and 0.9 apart; the sum of 0.3 and 0.5 would be less.
    old, new = [flat(0.0), flat(1.0)], [flat(0.1), flat(-0.3)]
    loose = MatchingOptions(threshold=math.inf)
    assert matched(loose, new, old) == [0, 1]
    assert matched(loose, new[::-1], old) == [1, 0]
    assert matched(MatchingOptions(threshold=0.5), new, old) == [0, None]
    assert matched(loose, [*new, flat(5.0)], old) == [0, 1, None]
    assert matched(loose, [], old) == []
    assert matched(loose, new, []) == [None, None]


def test_a_tie_goes_to_the_first() -> None:
    assert matched(MatchingOptions(), [flat(0.1), flat(-0.1)], [flat(0.0)]) == [0, None]
    assert matched(MatchingOptions(), [flat(0.0)], [flat(0.1), flat(-0.1)]) == [0]


def orbits_at(frequency: float) -> list[Orbit]:
    """The stable orbits of period 1 and their mirror images, A = 2, restitution 0.8."""
    motion = Harmonic(amplitude=2.0, frequency_ratio=frequency)
    found = find_orbits(DimensionlessBlock(restitution=0.8), motion, max_period=1)
    stable = [orbit for orbit in found if orbit.stable]
    return [image for orbit in stable for image in dict.fromkeys((orbit, orbit.mirrored))]


def test_a_distance_does_not_jump_where_an_impact_passes_the_phase() -> None:
    # Between these frequencies an impact passes phase 0: there the velocity jumps by a fifth.
    here, there = (orbits_at(frequency) for frequency in (1.931, 1.928))
    moved = [
        min(apart(MatchingOptions(), courses(one), courses(other)) for other in there)
        for one in here
    ]
    assert len(moved) == 2
    assert max(moved) < 0.02


def test_mirror_images_are_as_far_from_a_symmetric_orbit() -> None:
    (symmetric,) = orbits_at(2.0)
    first, second = orbits_at(1.9)
    one, other = (
        apart(MatchingOptions(), courses(symmetric), courses(image)) for image in (first, second)
    )
    assert one == pytest.approx(other, rel=1e-9)
    assert one > 0.0


@every(
    ("how", "says"),
    [
        ({"distance": "euclid"}, "hausdorff"),
        ({"threshold": 0.0}, "above 0"),
        ({"threshold": math.nan}, "finite"),
    ],
)
def test_what_is_no_matching_is_refused(how: dict[str, object], says: str) -> None:
    with pytest.raises(InputError, match=says):
        MatchingOptions(**how)  # type: ignore[arg-type]
