"""Points of codimension two: each kind in 50 digits, and why there are no others."""

from functools import cache
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.optimize import root

from rocksteady import DimensionlessBlock, Harmonic, find_bifurcation_curves
from rocksteady.branches import BifurcationCurves, BranchPoint, CurveOptions
from rocksteady.dynamics.continuation.chains.chain import Chain
from rocksteady.dynamics.continuation.chains.point_types import PointType
from rocksteady.dynamics.continuation.curves import _curve_starts
from rocksteady.dynamics.continuation.curves._codimension_two import (
    flip_type,
    free,
    graze_type,
)
from rocksteady.dynamics.continuation.curves._curve_starts import departures
from rocksteady.dynamics.continuation.from_orbit import chain_at
from rocksteady.kernels.orbits.chains import LANDING
from tests.dynamics.continuation.branches import random_start
from tests.dynamics.continuation.curves.fifty_digits import solved_again
from tests.dynamics.continuation.curves.twice import curves_listed_twice, points_listed_twice
from tests.every import every

PLANE = ("frequency_ratio", "amplitude")
HILLTOP = ((1.2, 3.2), (1.0, 6.0))
LOW = ((0.5, 2.5), (1.0, 5.0))
FAST = ((2.0, 6.0), (1.0, 8.0))


@cache
def around_the_doubling_graze() -> BifurcationCurves:
    return find_bifurcation_curves(
        DimensionlessBlock(restitution=0.87),
        Harmonic(amplitude=3.0, frequency_ratio=4.2),
        within=((4.4, 5.4), (2.5, 4.0)),
        search=CurveOptions(orders=(3,), lines=(1, 1), max_impacts=4),
    )


def point_of(found: BifurcationCurves, kind: str, **more: object) -> BranchPoint:
    return next(
        each.point
        for each in found.points
        if each.point.type == kind
        and all(getattr(each.point, key) == value for key, value in more.items())
    )


def values_of(point: BranchPoint) -> list[float]:
    return [point.frequency_ratio, point.amplitude]


@pytest.mark.slow
def test_the_doubling_graze_of_the_atlas() -> None:
    found = around_the_doubling_graze()
    point = point_of(found, "doubling-graze", period=3)
    assert (round(point.frequency_ratio, 4), round(point.amplitude, 4)) == (5.1328, 3.7521)
    assert values_of(point) == pytest.approx(solved_again(point, (1, 0)), abs=1e-9)
    (meeting,) = (each for each in found.points if each.point is point)
    kinds = sorted((found.curves[k - 1].type, found.curves[k - 1].period) for k in meeting.curves)
    # The graze of what is doubled there begins at the point, beside that of the motion itself.
    assert kinds == [("grazing", 3), ("grazing", 6), ("period-doubling", 3)]


@pytest.mark.slow
def test_fold_and_flip_meet_where_two_impacts_merge_and_nowhere_else() -> None:
    found = around_the_doubling_graze()
    point = point_of(found, "resonant-graze", period=3)
    exact = solved_again(point, (1, 0))
    assert values_of(point) == pytest.approx(exact, abs=1e-9)
    (meeting,) = (each for each in found.points if each.point is point)
    kinds = sorted((found.curves[k - 1].type, found.curves[k - 1].impacts) for k in meeting.curves)
    assert kinds == [("fold", 4), ("grazing", 2), ("period-doubling", 4)]
    # Each of the three comes to it by itself.
    for number in meeting.curves:
        near = [
            values_of(each)
            for each in found.curves[number - 1].points
            if each.type == "resonant-graze"
        ]
        assert min(np.abs(np.array(near) - exact).max(axis=1)) < 1e-9


@cache
def over_restitution() -> BifurcationCurves:
    return find_bifurcation_curves(
        DimensionlessBlock(restitution=0.5),
        Harmonic(amplitude=2.0, frequency_ratio=1.8),
        ("restitution", "amplitude"),
        within=((0.1, 0.4), (1.2, 2.5)),
        search=CurveOptions(orders=(1,), lines=(1, 0), max_impacts=4, max_period=2),
    )


@pytest.mark.slow
def test_a_fold_of_doubled_motions_ends_where_the_doubling_is_degenerate() -> None:
    found = over_restitution()
    points = [each for each in found.points if each.point.type == "generalised-doubling"]
    assert len(points) == 2
    for each in points:
        exact = solved_again(each.point, (2, 0))
        here = [each.point.restitution, each.point.amplitude]
        assert here == pytest.approx(exact, abs=1e-9)
        doubling, fold = (found.curves[number - 1] for number in each.curves)
        assert (doubling.type, fold.type) == ("period-doubling", "fold")
        assert (doubling.impacts, fold.impacts) == (2, 4)
        # Along the fold the square of what sets the halves apart vanishes at the point.
        apart = [
            np.sum(np.square(np.asarray(point.chain.halves_apart))) for point in fold.points[1:5]
        ]
        ends = np.polynomial.polynomial.polyfit(apart, fold.values[1:5], 3)[0]
        assert ends == pytest.approx(exact, abs=1e-6)


@pytest.mark.slow
def test_the_breaking_graze_of_the_subharmonic_motion() -> None:
    found = find_bifurcation_curves(
        DimensionlessBlock(restitution=0.8),
        Harmonic(amplitude=3.0, frequency_ratio=3.0),
        within=((10.5, 12.0), (6.0, 20.0)),
        search=CurveOptions(orders=(3,), lines=(1, 1), max_impacts=2),
    )
    point = point_of(found, "breaking-graze")
    assert values_of(point) == pytest.approx(solved_again(point, (1, 0)), abs=1e-9)
    assert sorted((curve.type.value, curve.symmetric) for curve in found.curves) == [
        ("grazing", False),
        ("grazing", True),
        ("symmetry-breaking", True),
    ]


GRAZING_FLIPS = {
    "half of an orbit": (0.8, [0], 3, (9.23, 11.56), [2.462]),
    "the first arc": (0.87, [0, 3], 6, (3.752, 5.133), [3.391, 1.588]),
    "the last arc": (0.87, [0, 3], 6, (3.752, 5.133), [1.588, 3.391]),
}


def flip_that_grazes(name: str) -> Chain:
    """Return a chain whose multiplier is -1 while an arc touches the floor."""
    restitution, turns, half_cycles, near, phases = GRAZING_FLIPS[name]

    def chain_of(unknowns: np.ndarray) -> Chain:
        return Chain(
            parameters=np.array([*unknowns[:2], restitution]),
            turns=np.array(turns),
            phases=unknowns[2:],
            half_cycles=half_cycles,
        )

    def conditions(unknowns: np.ndarray) -> list[float]:
        chain = chain_of(unknowns)
        return [*chain.errors, np.nanmin(chain.shape[:, 1]), chain.determinant(-1.0)]

    found = root(conditions, [*near, *phases], tol=1e-13)
    assert np.abs(found.fun).max() < 1e-12
    return chain_of(found.x)


@every("name", GRAZING_FLIPS)
def test_the_graze_of_what_branches_off_begins_along_its_tangent(
    name: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    flip = flip_that_grazes(name)
    amplitude, frequency, _ = flip.parameters.tolist()
    within = np.array([[frequency - 1.0, frequency + 1.0], [amplitude - 3.0, amplitude + 3.0]])
    monkeypatch.setattr(_curve_starts, "FIRST_STEPS", (1e-3,))
    ((begun,),) = (
        each
        for each in departures(graze_type(flip_type(flip)), flip, (1, 0), within, 0.02)
        if each and each[0].begin.solution.chain.impacts == 2 * flip.impacts
    )
    chord = begun.begin.place - begun.family.place_of(flip.doubled())
    # The step is put right across its direction: it is longer by the cosine of what it is off by.
    assert np.linalg.norm(chord) == pytest.approx(1e-3, rel=1e-5)


@cache
def with_grazes() -> BifurcationCurves:
    return find_bifurcation_curves(
        DimensionlessBlock(restitution=0.5),
        Harmonic(amplitude=4.91004502, frequency_ratio=5.4),
        ("restitution", "frequency_ratio"),
        within=((0.3, 0.6), (5.0, 6.0)),
        search=CurveOptions(orders=(5,), lines=(5, 0), max_impacts=4, max_period=5),
    )


@pytest.mark.slow
def test_a_fold_graze_and_a_doubling_graze_beside_it() -> None:
    found = with_grazes()
    for kind in ("fold-graze", "doubling-graze"):
        point = point_of(found, kind)
        exact = solved_again(point, (2, 1))
        assert [point.restitution, point.frequency_ratio] == pytest.approx(exact, abs=1e-9)


@pytest.mark.slow
def test_a_double_graze_and_the_curves_on_which_either_arc_touches() -> None:
    found = with_grazes()
    point = point_of(found, "double-graze", impacts=2)
    exact = solved_again(point, (2, 1))
    assert [point.restitution, point.frequency_ratio] == pytest.approx(exact, abs=1e-9)
    (meeting,) = (each for each in found.points if each.point is point)
    assert sum(found.curves[number - 1].impacts == 2 for number in meeting.curves) == 2


@pytest.mark.slow
def test_a_cusp_of_motions_that_hang_together_with_no_symmetric_one() -> None:
    found = find_bifurcation_curves(
        DimensionlessBlock(restitution=0.8),
        Harmonic(amplitude=2.0, frequency_ratio=1.8),
        ("restitution", "amplitude"),
        within=((0.84, 0.92), (1.55, 1.8)),
        search=CurveOptions(lines=(1, 0), max_impacts=6, max_period=4, everywhere=True),
    )
    point = point_of(found, "cusp")
    exact = solved_again(point, (2, 0))
    assert [point.restitution, point.amplitude] == pytest.approx(exact, abs=1e-9)
    (meeting,) = (each for each in found.points if each.point is point)
    (number,) = meeting.curves
    curve = found.curves[number - 1]
    # Both parameters turn back there: the two folds lie on one side.
    at = curve.points.index(point)
    before, after = (curve.values[at + step] - curve.values[at] for step in (-2, 2))
    assert float(before @ after) > 0.9 * np.linalg.norm(before) * np.linalg.norm(after)


@given(seed=st.integers(0, 10_000))
def test_a_fold_and_a_flip_exclude_each_other(seed: int) -> None:
    # C1: the difference of the determinants is a product of speeds, none of which is 0.
    orbit = random_start(np.random.default_rng(seed))
    if orbit is None:
        return
    chain = chain_at(orbit)
    _, frequency, restitution = chain.parameters
    count = chain.impacts
    landing = chain.table[:, LANDING]
    slopes = landing / (frequency * np.sinh(chain.durations))
    told = 2.0 * (-1) ** (count + 1) * (1.0 + restitution ** (2 * count)) * np.prod(slopes)
    plus, minus = (np.linalg.det(chain.matrix(closing)) for closing in (1.0, -1.0))
    assert plus - minus == pytest.approx(told, rel=1e-6, abs=1e-13)
    assert (landing > 0.0).all()
    first, second = chain.multipliers
    whole = 2 * count * (2 if chain.symmetric else 1)
    assert first * second == pytest.approx(restitution**whole, rel=1e-9)


def held_to_their_conditions(
    restitution: float,
    within: tuple[tuple[float, float], tuple[float, float]],
    search: CurveOptions,
) -> BifurcationCurves:
    """Hold all points of a plane to their conditions in 50 digits, and list nothing twice."""
    block = DimensionlessBlock(restitution=restitution)
    motion = Harmonic(amplitude=1.5, frequency_ratio=2.0)
    found = find_bifurcation_curves(block, motion, within=within, search=search)
    for each in found.points:
        assert values_of(each.point) == pytest.approx(solved_again(each.point, (1, 0)), abs=1e-9)
    assert curves_listed_twice(found) == points_listed_twice(found) == []
    return found


@pytest.mark.slow
@pytest.mark.parametrize(
    ("within", "search"),
    [
        (HILLTOP, CurveOptions(lines=(2, 1), max_impacts=2)),
        # Motions of two periods graze on the hilltop too: the touch of the first is the second's.
        (((0.75, 0.9), (1.5, 1.8)), CurveOptions(lines=(0, 1), max_impacts=2, everywhere=True)),
    ],
)
def test_motions_that_graze_on_the_hilltop_meet_nothing_there(
    within: tuple[tuple[float, float], tuple[float, float]], search: CurveOptions
) -> None:
    found = held_to_their_conditions(0.8, within, search)
    (curve,) = (
        each
        for each in found.curves
        if each.type == "grazing" and np.allclose(each.values @ [0, 1], 1 + each.values[:, 0] ** 2)
    )
    assert {curve.points[0].type, curve.points[-1].type} == {"end-of-range"}
    assert not found.points


@pytest.mark.slow
@pytest.mark.parametrize(
    ("restitution", "within", "search", "least"),
    [
        (0.8, HILLTOP, CurveOptions(max_impacts=6), 0),
        (0.45, LOW, CurveOptions(max_impacts=4, everywhere=True), 3),
        (0.95, FAST, CurveOptions(orders=(1, 3), max_impacts=4), 5),
    ],
)
def test_no_point_is_false_and_nothing_listed_twice(
    restitution: float,
    within: tuple[tuple[float, float], tuple[float, float]],
    search: CurveOptions,
    least: int,
) -> None:
    assert len(held_to_their_conditions(restitution, within, search).points) >= least


@every(
    ("dips", "kind", "expected"),
    [
        # Arc, the height of its dip, and when that is: arc 1 has no duration, all others 2.
        ({}, PointType.GRAZING, 1.0),
        ({2: (0.3, 1.0)}, PointType.GRAZING, 0.3),
        ({3: (-0.4, 0.0)}, PointType.GRAZING, -0.4),
        ({1: (-0.5, 0.0)}, PointType.GRAZING, 1.0),
        ({0: (-0.2, 2.0), 2: (-0.3, 0.0), 3: (0.1, 1.0)}, PointType.GRAZING, 0.1),
        ({0: (-0.2, 0.0)}, PointType.GRAZING, 1.0),
        ({0: (-0.2, 2.0 - 2e-6)}, PointType.GRAZING, -0.2),
        ({2: (-0.3, 2e-6)}, PointType.GRAZING, -0.3),
        ({0: (-0.2, 1.0), 2: (-0.3, 0.0)}, PointType.GRAZING, -0.2),
        ({2: (0.3, 1.0)}, PointType.FOLD, 0.0),
        ({2: (-0.3, 0.0)}, PointType.FOLD, -0.3),
    ],
)
def test_what_is_free_beside_two_merged_impacts_is_all_but_their_own_touch(
    dips: dict[int, tuple[float, float]], kind: PointType, expected: float
) -> None:
    durations, shape = np.array([2.0, 0.0, 2.0, 2.0]), np.full((4, 3), np.nan)
    for arc, dip in dips.items():
        shape[arc, 1:] = dip
    # Turned by any number of arcs it is the same orbit.
    for shift in range(4):
        chain: Any = SimpleNamespace(
            impacts=4, durations=np.roll(durations, shift), shape=np.roll(shape, shift, axis=0)
        )
        solution: Any = SimpleNamespace(chain=chain)
        assert free(kind, chain)(solution) == expected


def test_what_is_free_beside_a_touch_is_each_other_arc_and_every_duration() -> None:
    shape = np.full((3, 3), np.nan)
    shape[0, 1:], shape[2, 1:] = (0.2, 0.5), (1e-12, 0.5)
    chain: Any = SimpleNamespace(impacts=3, durations=np.array([2.0, 0.7, 0.6]), shape=shape)
    solution: Any = SimpleNamespace(chain=chain)
    assert free(PointType.GRAZING, chain)(solution) == 0.2
    assert free(PointType.FOLD, chain)(solution) == 1e-12
    shape[0, 1] = 0.9
    assert free(PointType.GRAZING, chain)(solution) == 0.6
