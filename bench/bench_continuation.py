"""Branches of orbits with their bifurcations, on one core."""

import time
from itertools import islice
from typing import Any

import pytest

from rocksteady import DimensionlessBlock, Harmonic, find_orbits
from rocksteady.branches import Branch, BranchPoint, PointType, find_cascade, follow_branch

SHAKING = Harmonic(amplitude=2.0, frequency_ratio=2.0)
RANGE = (0.5, 8.0)
POINTS = 500


def start() -> Any:
    return find_orbits(DimensionlessBlock(restitution=0.8), SHAKING, max_period=1)[0]


@pytest.mark.benchmark(group="continuation", timer=time.process_time)
def test_a_branch_of_500_points(benchmark: Any) -> None:
    """Points with multipliers and admissibility, as a plot wants them."""
    orbit = start()

    def run() -> Branch:
        followed = follow_branch(orbit, "frequency_ratio", RANGE, largest_step=0.001)
        branch = Branch(parameter="frequency_ratio", points=tuple(islice(followed, POINTS)))
        assert len(branch.points) == len(branch.stable) == POINTS
        return branch

    benchmark.pedantic(run, rounds=5, warmup_rounds=1)
    benchmark.extra_info["points"] = POINTS


@pytest.mark.benchmark(group="continuation", timer=time.process_time)
def test_a_cascade_of_six_doublings(benchmark: Any) -> None:
    orbit = start()

    def run() -> tuple[BranchPoint, ...]:
        return find_cascade(orbit, "frequency_ratio", (1.7, 2.0), direction=-1).points

    found = benchmark.pedantic(run, rounds=5, warmup_rounds=1)
    assert all(point.type is PointType.PERIOD_DOUBLING for point in found)
    benchmark.extra_info["points"] = len(found)
