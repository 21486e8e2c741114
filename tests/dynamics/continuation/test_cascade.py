"""The cascade of the paper's harmonic orbits: each doubling by the map, and Feigenbaum's ratio."""

import math

import numpy as np
import pytest

from rocksteady import find_attractor, find_orbits
from rocksteady.branches import Cascade, find_cascade, follow_branch
from rocksteady.errors import InputError, ModelError
from rocksteady.formulas import symmetry_breaking_amplitude
from tests.dynamics.continuation.branches import first, located, setting, special, symmetric_start
from tests.every import every

FEIGENBAUM = 4.669201609102990


@pytest.fixture(scope="module")
def found() -> Cascade:
    start = symmetric_start(2.0, 2.0, 0.8)
    return find_cascade(start, "frequency_ratio", (1.7, 2.0), direction=-1, doublings=6)


def test_each_doubling_is_one_by_the_return_map(found: Cascade) -> None:
    assert [point.period for point in found.points] == [1, 2, 4, 8, 16, 32]
    assert [point.impacts for point in found.points] == [2, 4, 8, 16, 32, 64]
    for point in found.points[:4]:
        exact = located(point, "frequency_ratio", -1.0)
        assert point.frequency_ratio == pytest.approx(exact, rel=1e-12)
    for point in found.points:
        assert point.type == "period-doubling"
        assert point.multipliers[0] == pytest.approx(-1.0, abs=1e-6)
        assert point.multipliers[1] == pytest.approx(-(0.8 ** (2 * point.impacts)), rel=1e-5)


def test_a_dataset_numbers_the_doublings_from_one(found: Cascade) -> None:
    data = found.to_dataset()
    assert data["doubling"].values.tolist() == [1, 2, 3, 4, 5, 6]
    assert data["period"].sel(doubling=3) == 4
    assert data["frequency_ratio"].values.tolist() == list(found.values)


def test_it_lies_where_the_paper_has_its_doubled_orbit(found: Cascade) -> None:
    # Doubled at 1.78, gone by 1.77 (TW7).
    assert 1.78 < found.values[0] < 1.80
    assert found.values[1] < 1.78
    assert 1.77 < found.limit < found.values[-1]
    assert (np.diff(found.values) < 0.0).all()


def test_the_ratios_of_its_distances_tend_to_feigenbaums(found: Cascade) -> None:
    assert found.distances == pytest.approx(np.diff(found.values))
    assert found.ratios == pytest.approx(found.distances[:-1] / found.distances[1:])
    away = np.abs(found.ratios - FEIGENBAUM)
    assert away[0] > away[1] > away[2]
    assert away[-1] < 0.005
    assert found.limit == pytest.approx(1.77168218, abs=2e-8)


def test_between_two_doublings_the_doubled_orbit_attracts(found: Cascade) -> None:
    for k in range(3):
        middle = 0.5 * (found.values[k] + found.values[k + 1])
        block, shaking = setting((2.0, middle, 0.8))
        orbit = found.points[k].orbit
        settled = find_attractor(block, shaking, start=orbit.start, max_cycles=20_000)
        # The start lies at a doubling nearby: what it settles to has the next period.
        if settled.orbit is not None:
            assert settled.period == 2 ** (k + 1)


@pytest.mark.slow
def test_shorter_steps_find_the_same() -> None:
    start = symmetric_start(2.0, 2.0, 0.8)
    one, other = (
        find_cascade(
            start, "frequency_ratio", (1.7, 2.0), direction=-1, doublings=4, largest_step=step
        )
        for step in (0.02, 0.003)
    )
    assert one.values == pytest.approx(other.values, rel=1e-12)


def test_from_an_orbit_that_leans_it_is_the_same(found: Cascade) -> None:
    leaning = [o for o in find_orbits(*setting((2.0, 1.9, 0.8)), max_period=1) if not o.symmetric]
    one = find_cascade(leaning[0], "frequency_ratio", (1.7, 2.0), direction=-1, doublings=2)
    assert one.values == pytest.approx(found.values[:2], rel=1e-12)
    breaking = first(
        follow_branch(symmetric_start(2.0, 2.0, 0.8), "frequency_ratio", (1.7, 2.0), direction=-1),
        "symmetry-breaking",
    )
    assert breaking.frequency_ratio > found.values[0]


def test_a_few_doublings_have_no_limit_yet() -> None:
    start = symmetric_start(2.0, 2.0, 0.8)
    few = find_cascade(start, "frequency_ratio", (1.7, 2.0), direction=-1, doublings=2)
    assert len(few.points) == 2
    assert few.ratios.shape == (0,)
    assert math.isnan(few.limit)


@pytest.mark.parametrize("point", [(2.83, 5.12, 0.88), (2.82, 5.18, 0.79)])
def test_a_bubble_ends_a_cascade_instead_of_running_to_and_fro(
    point: tuple[float, float, float],
) -> None:
    # The symmetry breaks and is whole again, with no doubling between.
    start = symmetric_start(*point, order=3)
    branch = follow_branch(start, "restitution", (0.05, 0.999), direction=-1)
    breaking = first(branch, "symmetry-breaking")
    bubble = special(follow_branch(breaking, "restitution", (0.05, 0.999), switch=True))
    assert [each.type.value for each in bubble] == ["symmetry-breaking"] * 2
    for end in bubble:
        exact = symmetry_breaking_amplitude(point[1], end.restitution, order=3)
        assert end.amplitude == pytest.approx(float(exact), rel=1e-11)
    with pytest.raises(ModelError, match="has no period doubling"):
        find_cascade(start, "restitution", (0.05, 0.999), direction=-1)


def test_where_there_is_no_doubling_that_is_said() -> None:
    start = symmetric_start(1.0, 4.0, 0.8)
    with pytest.raises(ModelError, match="has no period doubling") as raised:
        find_cascade(start, "frequency_ratio", (3.0, 6.0))
    assert "\n" not in str(raised.value)


@every("doublings", [0, 11, 2.5, True, None])
def test_the_number_of_doublings_is_validated(doublings: object) -> None:
    start = symmetric_start(2.0, 2.0, 0.8)
    with pytest.raises(InputError, match="doublings"):
        find_cascade(
            start,
            "frequency_ratio",
            (1.7, 2.0),
            doublings=doublings,  # type: ignore[arg-type]
        )
