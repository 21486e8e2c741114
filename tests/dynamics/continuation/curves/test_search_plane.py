"""Planes of the nonlinear model and of unlike sides: shooting, limits, mirror images."""

import math

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
from rocksteady.branches import BifurcationCurves, CurveOptions
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
