"""Sampling of a curve: circles of any size keep close to their chords, and few points do."""

import math

import numpy as np

from rocksteady.arrays import Floats
from rocksteady.dynamics.edges._leaving import Images
from rocksteady.dynamics.edges._sampling import Plane, sampled
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
