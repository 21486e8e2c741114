"""Sampling of a curve: circles of any size keep close to their chords, and few points do."""

import math

import numpy as np

from rocksteady.arrays import Floats
from rocksteady.dynamics.edges._leaving import Images
from rocksteady.dynamics.edges._sampling import Plane, _coarse, sampled
from tests.every import every

SPACING = 0.1


@every("radius", [0.01, 0.03, 0.1, 0.4, 0.9])
def test_a_circle_is_sampled_within_a_part_of_the_spacing(radius: float) -> None:
    def circle(labels: Floats) -> Images:
        none = np.zeros(len(labels), dtype=np.int64)
        x, y = radius * np.cos(labels), radius * np.sin(labels)
        return Images(x, y, none, none, none.astype(bool))

    plane = Plane(np.zeros(2), np.ones(2), 0.0)
    kept = sampled(circle, np.linspace(0.0, 2.0 * math.pi, 5), plane, SPACING, 10_000)
    steps = np.diff(kept.labels)
    sagitta = radius * (1.0 - np.cos(0.5 * steps))
    assert kept.complete
    assert not kept.broken.any()
    assert sagitta.max() < SPACING / 75.0
    assert steps.max() < 0.31  # of what turns, however small
    assert 2.0 * radius * np.sin(0.5 * steps.max()) <= SPACING
    assert len(steps) <= 2.0 * max(2.0 * math.pi / 0.3, 2.0 * math.pi * radius / (0.1 * SPACING))


def test_a_window_has_its_border_and_what_turns_only_the_border_of_the_other() -> None:
    x = np.array([0.5, 0.0, 1.0, 1.0, 1.0 + 1e-15, np.nan, 0.5, 0.5, np.inf])
    y = np.array([0.0, -2.0, 2.0, 0.0, 0.0, 0.0, np.nan, 2.0 + 1e-15, 0.0])
    none = np.zeros(len(x), dtype=np.int64)
    images = Images(x, y, none, none, none > 0)
    plane = Plane(np.array([0.5, 0.0]), np.array([0.5, 2.0]), 0.0)
    assert plane.inside(images).tolist() == [True] * 4 + [False] * 5
    round_about = plane._replace(turn=2.0 * math.pi)
    assert round_about.inside(images).tolist() == [True] * 5 + [False] * 4


def test_what_is_beyond_a_window_is_drawn_between_one_and_two_half_widths() -> None:
    x = np.array([1.0, 3.0, 5.0, -1.0, -7.0, np.inf])
    none = np.zeros(len(x), dtype=np.int64)
    images = Images(x, x, none, none, none > 0)
    plane = Plane(np.array([1.0, 0.0]), np.array([2.0, 1.0]), 0.0)
    across = [0.0, 1.0, 1.5, -1.0, -1.75, 2.0]  # 2 - 1/z where z > 1
    up = [1.0, 2.0 - 1.0 / 3.0, 1.8, -1.0, -2.0 + 1.0 / 7.0, 2.0]
    np.testing.assert_allclose(plane.seen(images), np.column_stack([across, up]), rtol=1e-15)
    turning = plane._replace(turn=3.0)
    seen = turning.seen(images)
    np.testing.assert_allclose(seen, np.column_stack([(x - 1.0) / 2.0, up]), rtol=1e-15)
    # Once round is 3, which is 1.5 half widths.
    steps = turning.chords(seen[:5])
    np.testing.assert_allclose(steps[:, 0], [-0.5, -0.5, 0.0, 0.0], atol=1e-15)
    np.testing.assert_allclose(steps[:, 1], np.diff(up[:5]), rtol=1e-15)


def test_both_arms_of_a_bend_are_refined_wherever_it_is() -> None:
    # Straight on, and two right angles far from the first point.
    x = np.array([0.0, 0.09, 0.14, 0.19, 0.19, 0.19, 0.14])
    y = np.array([0.0, 0.0, 0.0, 0.0, 0.05, 0.1, 0.1])
    none = np.zeros(len(x), dtype=np.int64)
    flagged, apart = _coarse(
        Plane(np.zeros(2), np.ones(2), 0.0), Images(x, y, none, none, none > 0), SPACING
    )
    assert flagged.tolist() == [False, False, True, True, True, True]
    assert not apart.any()


def test_between_two_points_that_are_nowhere_there_is_a_gap_and_nothing_to_refine() -> None:
    x = np.array([0.0, np.nan, np.nan, 0.0, 0.05, np.nan])
    none = np.zeros(len(x), dtype=np.int64)
    flagged, apart = _coarse(
        Plane(np.zeros(2), np.ones(2), 0.0), Images(x, 0.0 * x, none, none, none > 0), SPACING
    )
    assert flagged.tolist() == [True, False, True, False, True]
    assert apart.tolist() == [True, True, True, False, True]
