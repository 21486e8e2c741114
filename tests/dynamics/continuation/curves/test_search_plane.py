"""Planes of the nonlinear model and of unlike sides: shooting, limits, mirror images."""

import heapq
import math
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from rocksteady import (
    Block,
    DimensionlessBlock,
    Harmonic,
    Linear,
    Nonlinear,
    find_bifurcation_curves,
    find_orbits,
)
from rocksteady.branches import BifurcationCurves, BranchPoint, CurveOptions
from rocksteady.dynamics.continuation.chains.chain import Chain
from rocksteady.dynamics.continuation.chains.point_types import PointType
from rocksteady.dynamics.continuation.curves import search_plane
from rocksteady.dynamics.continuation.from_orbit import chain_at
from rocksteady.errors import ModelError
from rocksteady.formulas import symmetry_breaking_frequencies
from rocksteady.kernels.orbits.chains import LANDING
from tests.dynamics.continuation.curves.jets import solved_twice
from tests.dynamics.shooting import Rocking
from tests.every import every

SHAKEN = ("frequency_ratio", "amplitude")
OVER_RESTITUTION = ("restitution", "amplitude")
SIDES = Block.asymmetric(left=0.15, right=0.2, height=1.2, restitution=(0.85, 0.8))
TURNED = Block.asymmetric(left=0.2, right=0.15, height=1.2, restitution=(0.8, 0.85))
CONDITIONS = {
    "doubling-graze": (-1.0, True),
    "fold-graze": (1.0, True),
    "generalised-doubling": (-1.0, False),
    "cusp": (1.0, False),
}


def block_of(alpha: float, restitution: float) -> Block:
    return Block.from_p(alpha=alpha, p=3.0, restitution=restitution)


def subharmonics(
    block: Block | DimensionlessBlock,
    within: tuple[tuple[float, float], tuple[float, float]],
    model: Linear | Nonlinear | None = None,
) -> BifurcationCurves:
    """The plane of the atlas, n = 3, delta = .87: leaning motions double and graze."""
    return find_bifurcation_curves(
        block,
        Harmonic(amplitude=3.0, frequency_ratio=4.2),
        within=within,
        search=CurveOptions(orders=(3,), lines=(1, 0), max_impacts=2, max_period=3, max_branches=3),
        model=model,
    )


def harmonics(
    block: Block | DimensionlessBlock, model: Linear | Nonlinear | None = None
) -> BifurcationCurves:
    """A plane of n = 1 in which the doubling of leaning motions is degenerate twice."""
    return find_bifurcation_curves(
        block,
        Harmonic(amplitude=2.0, frequency_ratio=1.8),
        OVER_RESTITUTION,
        within=((0.1, 0.4), (1.2, 2.8)),
        search=CurveOptions(lines=(1, 0), max_impacts=4, max_period=2),
        model=model,
    )


def held_to_shooting(found: BifurcationCurves, kind: str, *, most: int = 10) -> None:
    """Hold the points of a type to two conditions on a return map flown by DOP853."""
    points = [each.point for each in found.points if each.point.type == kind]
    assert points
    multiplier, touches = CONDITIONS[kind]
    for point in points[:most]:
        exact = solved_twice(point, found.parameters, multiplier, touches=touches)
        here = [getattr(point, name) for name in found.parameters]
        assert here == pytest.approx(exact, abs=1e-10)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("alpha", "within"),
    [
        (0.1, ((5.05, 5.15), (2.9, 3.85))),
        (0.5, ((3.6, 5.4), (2.5, 4.6))),
    ],
)
def test_doubling_grazes_are_those_of_shooting(
    alpha: float, within: tuple[tuple[float, float], tuple[float, float]]
) -> None:
    found = subharmonics(block_of(alpha, 0.87), within, Nonlinear())
    held_to_shooting(found, "doubling-graze")
    told = found.to_dict()
    assert (told["model"], told["block"]["alpha_rad"]) == ("nonlinear", pytest.approx(alpha))
    assert f"nonlinear model, alpha {alpha} rad" in found.describe().headline
    for curve in found.curves:
        assert (curve.model, curve.block) == (Nonlinear(), found.block)
        assert f"nonlinear model, alpha {alpha} rad" in curve.describe().headline


@pytest.mark.slow
def test_generalised_doublings_are_those_of_shooting() -> None:
    held_to_shooting(harmonics(block_of(0.3, 0.5), Nonlinear()), "generalised-doubling", most=1)


@pytest.mark.slow
def test_cusps_are_those_of_shooting() -> None:
    found = find_bifurcation_curves(
        block_of(0.1, 0.8),
        Harmonic(amplitude=2.0, frequency_ratio=1.8),
        OVER_RESTITUTION,
        within=((0.84, 0.92), (1.55, 1.8)),
        search=CurveOptions(lines=(1, 0), max_impacts=6, max_period=4, everywhere=True),
        model=Nonlinear(),
    )
    held_to_shooting(found, "cusp", most=1)


@pytest.mark.slow
def test_a_fold_graze_and_the_doubling_graze_beside_it_are_those_of_shooting() -> None:
    found = find_bifurcation_curves(
        block_of(0.1, 0.5),
        Harmonic(amplitude=4.91004502, frequency_ratio=5.4),
        ("restitution", "frequency_ratio"),
        within=((0.3, 0.6), (5.0, 6.0)),
        search=CurveOptions(orders=(5,), lines=(3, 0), max_impacts=4, max_period=5),
        model=Nonlinear(),
    )
    held_to_shooting(found, "fold-graze")
    held_to_shooting(found, "doubling-graze")


def points_of(found: BifurcationCurves) -> list[tuple[str, float, float]]:
    return sorted(
        (each.point.type.value, *(getattr(each.point, name) for name in found.parameters))
        for each in found.points
    )


@pytest.mark.slow
def test_points_tend_to_the_linear_ones_as_the_square_of_the_slenderness() -> None:
    def values(block: Block | DimensionlessBlock, model: Linear | Nonlinear) -> np.ndarray:
        listed = points_of(subharmonics(block, ((4.4, 5.4), (2.5, 4.0)), model))
        listed += points_of(harmonics(block.with_restitution(0.5), model))
        kinds.append([kind for kind, *_ in listed])
        return np.array([place for _, *place in listed])

    kinds: list[list[str]] = []
    straight = values(DimensionlessBlock(restitution=0.87), Linear())
    coarse, fine = (values(block_of(alpha, 0.87), Nonlinear()) for alpha in (0.04, 0.02))
    assert kinds[0] == kinds[1] == kinds[2]
    assert kinds[0] == ["doubling-graze", "resonant-graze"] + 2 * ["generalised-doubling"]
    moved = np.abs(straight - fine) > 1e-5
    assert moved.any(axis=1).all()
    ratios = (coarse - straight)[moved] / (fine - straight)[moved]
    np.testing.assert_allclose(ratios, 4.0, rtol=0.02)


def leaning(block: Block, model: Linear | Nonlinear, lean: float, rate: float) -> BifurcationCurves:
    return find_bifurcation_curves(
        block,
        Harmonic(amplitude=2.2 / lean, frequency_ratio=2.0 / rate),
        within=((1.5 / rate, 2.6 / rate), (1.6 / lean, 3.0 / lean)),
        search=CurveOptions(lines=(1, 1), max_impacts=2, max_period=1),
        model=model,
    )


@pytest.mark.parametrize("model", [Linear(), pytest.param(Nonlinear(), marks=pytest.mark.slow)])
def test_a_block_turned_round_has_the_same_curves(model: Linear | Nonlinear) -> None:
    lean = TURNED.positive.alpha / SIDES.positive.alpha
    rate = TURNED.positive.p / SIDES.positive.p
    mine, theirs = leaning(SIDES, model, 1.0, 1.0), leaning(TURNED, model, lean, rate)
    scale = np.array([rate, lean])
    assert {curve.type.value for curve in mine.curves} >= {"fold", "period-doubling"}
    for curve in mine.curves:
        assert not any(point.symmetric for point in curve.points)
        assert curve.stable.any()
    # Steps of either are the same but for rounding, so that their ends are one place.
    ends, twins = (
        sorted(
            (curve.type.value, tuple(sorted(map(tuple, np.round(curve.values[[0, -1]] * unit, 8)))))
            for curve in found.curves
        )
        for found, unit in ((mine, np.ones(2)), (theirs, scale))
    )
    assert [kind for kind, _ in ends] == [kind for kind, _ in twins]
    np.testing.assert_allclose(
        [place for _, place in ends], [place for _, place in twins], atol=2e-8
    )
    told = mine.describe()
    assert "mirror" not in str(told.notes)
    assert mine.to_dict()["model"] == model.name


@every("model", [Linear(), Nonlinear()])
@every("block", [block_of(0.4, 0.8), SIDES])
def test_fold_and_flip_exclude_each_other_in_either_model(
    block: Block, model: Linear | Nonlinear
) -> None:
    # Equation P, kappa from flights by DOP853: the reciprocal of what a speed does to an angle.
    rocking = Rocking.of(block)
    motion = Harmonic(amplitude=2.2, frequency_ratio=2.3)
    found = find_orbits(block, motion, max_period=2, max_impacts=4, seeds=24, model=model)
    seen = 0
    for orbit in found:
        if orbit.rest_phases or not orbit.admissible:
            continue
        chain = chain_at(orbit)
        count, total = chain.impacts, 1.0
        for k in range(count):
            side = 1 if k % 2 == 0 else -1
            phase = float(chain.phases[k] + chain.turns[k] * math.pi)
            row = 0 if side > 0 else 1
            if isinstance(model, Linear):
                rate = rocking.rate[row]
                kappa = rate / math.sinh(rate * chain.durations[k])
            else:
                flight = (phase, float(chain.table[k, 0]), float(chain.durations[k]))
                end, _ = rocking.fly(side, chain.parameters, *flight)
                kappa = 1.0 / float(end[3])
            total *= kappa * float(chain.table[k, LANDING]) / chain.parameters[1]
        kept = math.prod(chain.sides[k % 2, 0] ** 2 for k in range(count))
        plus, minus = (np.linalg.det(chain.matrix(closing)) for closing in (1.0, -1.0))
        told = 2.0 * (-1) ** (count + 1) * (1.0 + kept) * total
        assert plus - minus == pytest.approx(told, rel=1e-7, abs=1e-12)
        seen += 1
    assert seen > 0


def test_over_restitution_both_impacts_have_the_same() -> None:
    found = find_bifurcation_curves(
        SIDES,
        Harmonic(amplitude=2.2, frequency_ratio=2.0),
        ("restitution", "frequency_ratio"),
        within=((0.6, 0.95), (1.5, 2.6)),
        search=CurveOptions(lines=(1, 0), max_impacts=2, max_period=1),
    )
    assert found.curves
    told = found.to_dict()
    assert told["block"]["restitution"] is told["block"]["negative"]["restitution"] is None
    for curve in found.curves:
        for point in curve.points:
            sides = point.block.dimensionless().sides
            assert sides[0][0] == sides[1][0] == point.restitution


def test_what_has_no_curves_is_refused_by_name() -> None:
    motion, within = Harmonic(amplitude=2.0, frequency_ratio=2.0), ((1.8, 2.2), (1.5, 2.5))
    wall = DimensionlessBlock(restitution=0.8, one_sided=True)
    for block, model, words in (
        (wall, None, "wall"),
        (DimensionlessBlock(restitution=0.8), Nonlinear(), "slenderness"),
    ):
        with pytest.raises(ModelError, match=words) as raised:
            find_bifurcation_curves(block, motion, within=within, model=model)
        assert "\n" not in str(raised.value)


@every(("highest", "motions"), [(1.97, ["unsymmetric", "symmetric"]), (1.9485, ["unsymmetric"])])
def test_a_region_ends_where_symmetry_breaks_and_a_narrow_one_is_left_out(
    highest: float, motions: list[str]
) -> None:
    found = find_bifurcation_curves(
        DimensionlessBlock(restitution=0.8),
        Harmonic(amplitude=2.0, frequency_ratio=1.9),
        within=((1.93, highest), (1.9, 2.1)),
        search=CurveOptions(lines=(0, 1), max_impacts=2, max_period=1),
    )
    assert [each.motions for each in found.regions] == [(word,) for word in motions]
    breaking = symmetry_breaking_frequencies(2.0, 0.8)
    assert np.abs(found.regions[0].extent[2] - breaking).min() < 1e-11
    assert found.regions[-1].extent[2] in (highest, found.regions[0].extent[2])


def chain_through(
    place: tuple[float, float], phases: tuple[float, ...] = (1.0, 2.0), *, later: int = 0
) -> Chain:
    """Return an unsymmetric chain at a frequency ratio and an amplitude."""
    ratio, amplitude = place
    turns = np.arange(len(phases), dtype=np.int64) + later
    parameters = np.array([amplitude, ratio, 0.8])
    return Chain(
        parameters=parameters,
        turns=turns,
        phases=np.array(phases) - later * math.pi,
        half_cycles=len(phases),
    )


def plane_search(**asked: Any) -> Any:
    """Return a search in a plane 4 wide and 20 high, which does not begin at 0."""
    return search_plane._Found(SHAKEN, ((2.0, 6.0), (10.0, 30.0)), CurveOptions(**asked))


@every(
    ("place", "share"),
    [
        ((3.0, 15.0), 0.5),
        ((2.5, 12.5), 0.25),
        ((2.5 + 0.0079, 12.5), 0.25 + 0.5 * 0.0079 / 2.0),
        ((2.0 - 0.0079, 10.0 - 0.0395), 0.0),
        ((4.0 + 0.0079, 20.0 + 0.0395), 1.0),
        ((2.0 - 0.0081, 10.0 - 0.0405), None),
        ((4.0 + 0.0081, 20.0 + 0.0405), None),
        ((3.0, 15.0 + 0.082), None),
        ((3.0 + 0.0165, 15.0), None),
    ],
)
@every("later", [0, 2])
def test_a_motion_beside_a_chord_is_held_to_the_one_between_its_ends(
    place: tuple[float, float], share: float | None, later: int
) -> None:
    one = chain_through((2.0, 10.0), (1.0, 2.0))
    other = chain_through((4.0, 20.0), (1.4, 1.8), later=later)
    search, chain = plane_search(), chain_through(place)
    near = search._between(one, other, chain, search._place(chain))
    if share is None:
        assert near is None
    else:
        assert near.phases == pytest.approx([1.0 + 0.4 * share, 2.0 - 0.2 * share])
        assert (near.parameters == chain.parameters).all()
        assert (near.turns == one.turns).all()


def test_a_chord_has_motions_of_one_shape_and_may_be_a_point() -> None:
    search = plane_search()
    ends = chain_through((2.0, 10.0)), chain_through((4.0, 20.0))
    four = chain_through((3.0, 15.0), (1.0, 1.2, 1.4, 1.6))
    assert search._between(*ends, four, search._place(four)) is None
    assert search._between(ends[0], four, ends[1], search._place(ends[1])) is None
    near = search._between(ends[0], ends[0], ends[0], search._place(ends[0]))
    assert (near.phases == ends[0].phases).all()


@every(
    ("phases", "kind", "known"),
    [
        ((1.0, 2.0), PointType.FOLD, True),
        ((1.019, 2.019), PointType.FOLD, True),
        ((1.021, 2.0), PointType.FOLD, False),
        ((1.0, 2.0), PointType.PERIOD_DOUBLING, False),
        # The mirror image sets off to the other side, half a period later.
        ((2.0, 1.0 + 1e-9), PointType.FOLD, True),
    ],
)
def test_a_curve_is_known_where_a_motion_on_it_or_its_mirror_image_is(
    phases: tuple[float, float], kind: PointType, *, known: bool
) -> None:
    search = plane_search()
    ends = [chain_through((2.0, 10.0)), chain_through((4.0, 20.0))]
    curve = SimpleNamespace(type=PointType.FOLD, points=[SimpleNamespace(chain=e) for e in ends])
    other = SimpleNamespace(type=PointType.GRAZING, points=curve.points)
    search.curves += [other, curve]
    assert search._known(kind, chain_through((3.0, 15.0), phases)) is known


def point_at(kind: PointType, place: tuple[float, float]) -> BranchPoint:
    return BranchPoint(type=kind, arclength=0.0, chain=chain_through(place))


def test_a_meeting_is_listed_once_with_the_curves_that_come_there() -> None:
    cusp, graze = PointType.CUSP, PointType.FOLD_GRAZE
    fold = point_at(PointType.FOLD, (3.0, 15.0))
    beside = (3.0 + 0.9 * 4e-6, 15.0 - 0.9 * 2e-5)
    above, right = (3.0, 15.0 + 1.1 * 2e-5), (3.0 + 1.1 * 4e-6, 15.0)
    search = plane_search()
    search.curves += [
        SimpleNamespace(points=points)
        for points in (
            [fold, point_at(cusp, (3.0, 15.0)), point_at(cusp, (3.0, 15.0))],
            [point_at(graze, (3.0, 15.0)), point_at(cusp, above)],
            [point_at(cusp, beside), point_at(cusp, right), fold],
            [fold],
        )
    ]
    found = [(each.point.type, *search._place(each.point.chain), each.curves)
             for each in search.meetings()]  # fmt: skip
    assert found == [
        (cusp, 0.75, 0.75, (1, 3)),
        (graze, 0.75, 0.75, (2,)),
        (cusp, 0.75, pytest.approx(0.75 + 1.1e-6, abs=1e-12), (2,)),
        (cusp, pytest.approx(0.75 + 1.1e-6, abs=1e-12), 0.75, (3,)),
    ]


def test_short_motions_are_followed_first_and_long_ones_not_at_all() -> None:
    search = plane_search(max_period=2)
    order = []
    for period, impacts in ((2, 4), (1, 4), (3, 2), (2, 2), (1, 2), (1, 2)):
        search.add(SimpleNamespace(period=period, impacts=impacts))
    while search.waiting:
        *_, point = heapq.heappop(search.waiting)
        order.append((point.period, point.impacts))
    assert order == [(1, 2), (1, 2), (1, 4), (2, 2), (2, 4)]


def branch_over(values: list[float], stable: list[tuple[int, int, bool]], **kind: Any) -> Any:
    stretches = [SimpleNamespace(first=a, last=b, stable=stays) for a, b, stays in stable]
    words = {"symmetric": True, "period": 1, **kind}
    return SimpleNamespace(values=np.array(values), stretches=stretches, **words)


@every("axis", [0, 1])
def test_regions_are_where_one_set_of_motions_is_stable(axis: int) -> None:
    ends = [(0.0, 1.0), (0.0, 1.0)]
    ends[axis] = (10.0, 20.0)
    one = branch_over([10.0, 12.0, 14.0, 20.0], [(0, 1, False), (1, 2, True), (2, 3, False)])
    two = branch_over([16.0, 13.0], [(0, 1, True)], symmetric=False, period=3)
    twin = branch_over([14.0, 15.0], [(0, 1, True)], symmetric=False, period=3)
    late = branch_over([19.0, 19.05], [(0, 1, True)])
    last = branch_over([19.1, 19.25], [(0, 1, True)])
    lines = [
        SimpleNamespace(axis=axis, value=0.5, branches=branches)
        for branches in ((one,), (two, twin), (late, last))
    ]
    lines.append(SimpleNamespace(axis=axis, value=0.7, branches=(one,)))
    found = [
        (each.place, each.motions, each.extent)
        for each in search_plane._regions(lines, (ends[0], ends[1]))  # type: ignore[arg-type]
    ]

    def region(value: float, low: float, high: float, *motions: str) -> Any:
        middle = 0.5 * (low + high)
        place = (middle, value) if axis == 0 else (value, middle)
        return pytest.approx(place), motions, pytest.approx((axis, low, high))

    assert found == [
        region(0.5, 12.0, 13.0, "symmetric"),
        region(0.5, 13.0, 14.0, "symmetric", "unsymmetric, 3 periods"),
        region(0.5, 14.0, 16.0, "unsymmetric, 3 periods"),
        region(0.5, 19.1, 19.25, "symmetric"),
        region(0.7, 12.0, 14.0, "symmetric"),
    ]
