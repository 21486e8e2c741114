"""Manifolds: invariance, borders of basins, the heteroclinic tangency in closed form."""

import math
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.interpolate import CubicSpline
from scipy.optimize import minimize_scalar

from rocksteady import (
    Block,
    DimensionlessBlock,
    Harmonic,
    Linear,
    Nonlinear,
    State,
    compute_basins,
    find_orbits,
    simulate,
)
from rocksteady.basins import (
    HilltopSaddle,
    Manifold,
    ManifoldBranch,
    compute_manifold,
    find_hilltop_saddles,
)
from rocksteady.dynamics.edges._flow import Flow
from rocksteady.dynamics.edges._leaving import FromHilltop, FromOrbit, Images
from rocksteady.dynamics.edges._sampling import Plane, Sampled
from rocksteady.dynamics.edges.growing import _branch, _end_of
from rocksteady.dynamics.orbits.return_map import harmonic
from rocksteady.dynamics.steady.heteroclinic import tangency_amplitude
from rocksteady.errors import ModelError
from rocksteady.formulas import heteroclinic_amplitude
from rocksteady.model.equations import Model
from rocksteady.orbits import Orbit, find_attractors
from rocksteady.outcomes import AttractorKind
from tests.every import every

Floats = NDArray[np.float64]
TURN = 2.0 * math.pi
H = 1e-6
"""Step in the label of a curve that gives its tangent."""

BARE = DimensionlessBlock(restitution=0.8)
SHAKEN = Harmonic(amplitude=2.0, frequency_ratio=1.9)


def saddle_orbit() -> Orbit:
    """Return the symmetric orbit that has lost its stability at the breaking of symmetry."""
    found = find_orbits(BARE, SHAKEN, max_period=1, seeds=12)
    return next(each for each in found if each.admissible and not each.stable)


def hilltop(block: Block | DimensionlessBlock, motion: Harmonic, model: Model) -> HilltopSaddle:
    """Return the saddle on the positive side."""
    return find_hilltop_saddles(block, motion, model=model)[0]


SADDLES = [
    (hilltop(DimensionlessBlock(restitution=0.9), Harmonic(amplitude=0.5, frequency_ratio=2.0),
             Linear()), 1e-10),
    (hilltop(DimensionlessBlock(restitution=0.9, alpha_ratio=1.2, p_ratio=0.9),
             Harmonic(amplitude=0.5, frequency_ratio=3.0), Linear()), 1e-10),
    (hilltop(DimensionlessBlock(restitution=0.7, one_sided=True),
             Harmonic(amplitude=0.7, frequency_ratio=3.0), Linear()), 1e-10),
    (hilltop(Block.from_p(alpha=0.3, p=2.0, restitution=0.85),
             Harmonic(amplitude=2.0, frequency_ratio=2.5), Nonlinear(tolerance=1e-12)), 1e-9),
    (saddle_orbit(), 1e-10),
]  # fmt: skip


@pytest.mark.slow
@every(("saddle", "slack"), SADDLES)
@every("kind", ["stable", "unstable"])
def test_the_map_takes_the_curve_along_itself(
    saddle: Orbit | HilltopSaddle, slack: float, kind: str
) -> None:
    backward = kind == "stable"
    found = compute_manifold(saddle, kind, length=3.0, spacing=0.05)  # type: ignore[arg-type]
    flow = Flow(saddle.block, harmonic(saddle.motion), saddle.model, backward=backward)
    start = FromHilltop if isinstance(saddle, HilltopSaddle) else FromOrbit
    checked = 0
    for branch in found.branches:
        leaving = start(saddle, backward=backward, sign=branch.sign)  # type: ignore[arg-type]
        turn = TURN * saddle.period * (-1.0 if backward else 1.0)
        for k in range(0, len(branch.first), max(1, len(branch.first) // 25)):
            point = float(branch.first[k]), float(branch.second[k])
            if point[0] == 0.0:
                continue
            image = flow.carried(*point, found.phase - turn, found.phase)
            label = float(branch.label[k]) + 1.0
            before, here, after = (
                np.array(leaving.at_phase(label + step, found.phase)[:2]) for step in (-H, 0.0, H)
            )
            if not np.isfinite([before, here, after]).all():
                continue
            if not 0.0 < np.hypot(*(after - before)) < 0.01:  # at rest, or at a jump
                continue
            missed = np.array([image.angle, image.velocity]) - here
            assert np.hypot(*missed) < 1e-5  # along the curve, where a rounding at the start grows
            along = (after - before) / np.hypot(*(after - before))
            across = abs(float(missed[0] * along[1] - missed[1] * along[0]))
            checked += 1
            assert across <= slack
    assert checked > 10


def test_it_leaves_an_orbit_along_the_eigenvector_of_its_map() -> None:
    saddle = saddle_orbit()
    phase = 1.0

    def mapped(angle: float, velocity: float) -> Floats:
        motion = Harmonic(amplitude=2.0, frequency_ratio=1.9, phase=phase)
        run = simulate(BARE, motion, start=State(angle=angle, velocity=velocity), cycles=1)
        end = run(TURN / 1.9)
        return np.array([float(end.angle), float(end.velocity)])

    for kind, which in (("unstable", 0), ("stable", 1)):
        found = compute_manifold(saddle, kind, phase=phase, length=0.2)  # type: ignore[arg-type]
        one, other = (np.array([each.first[0], each.second[0]]) for each in found.branches)
        middle = 0.5 * (one + other)
        h = 1e-6
        columns = [
            (mapped(*(middle + h * e)) - mapped(*(middle - h * e))) / (2.0 * h) for e in np.eye(2)
        ]
        monodromy = np.array(columns).T
        direction = one - other
        grown = monodromy @ direction
        expected = saddle.multipliers[which].real
        assert grown == pytest.approx(expected * direction, abs=1e-5 * float(np.hypot(*direction)))
        # Both branches begin on either side of the orbit itself.
        assert mapped(*middle) == pytest.approx(middle, abs=1e-10)


@pytest.mark.slow
def test_states_on_the_stable_manifold_come_to_the_saddle_at_the_rate_of_its_multiplier() -> None:
    saddle = saddle_orbit()
    found = compute_manifold(saddle, "stable", phase=1.0, length=2.0)
    branch = max(found.branches, key=lambda each: each.length)
    flow = Flow(BARE, SHAKEN, Linear())
    at = next(k for k in range(len(branch.first)) if branch.arclength[k] > 0.02)
    point = float(branch.first[at]), float(branch.second[at])
    home = flow.carried(*point, 1.0, 1.0 + 12 * TURN)
    away = []
    for period in range(1, 5):
        here = flow.carried(*point, 1.0, 1.0 + period * TURN)
        away.append(math.hypot(here.angle - home.angle, here.velocity - home.velocity))
    ratios = np.array(away[1:]) / np.array(away[:-1])
    assert ratios[-1] == pytest.approx(saddle.multipliers[1].real, rel=0.02)


@pytest.mark.slow
@every(
    ("amplitude", "ratio", "restitution", "phase"),
    [(0.2, 2.0, 0.9, 0.0), (0.4, 2.6, 0.87, 2.0), (0.15, 1.1, 0.83, 4.4)],
)
def test_stable_manifolds_of_hilltop_saddles_part_standing_from_falling(
    amplitude: float, ratio: float, restitution: float, phase: float
) -> None:
    # Below the heteroclinic tangency the border of overturning is these two curves alone.
    assert amplitude < heteroclinic_amplitude(ratio, restitution)
    motion = Harmonic(amplitude=amplitude, frequency_ratio=ratio, phase=phase)
    block = DimensionlessBlock(restitution=restitution)
    sides = [
        compute_manifold(saddle, "stable", phase=phase, length=8.0)
        for saddle in find_hilltop_saddles(block, motion)
    ]
    ones, others = [], []
    for found in sides:
        for branch in found.branches:
            for part in branch.pieces:
                path = np.column_stack([branch.first[part], branch.second[part]])
                step = np.diff(path, axis=0)
                length = np.hypot(*step.T)
                for k in np.flatnonzero(length > 1e-4)[::7]:
                    normal = np.array([-step[k, 1], step[k, 0]]) / length[k]
                    ones.append(path[k] + 1e-7 * normal)
                    others.append(path[k] - 1e-7 * normal)
    falls = []
    for points in (np.array(ones), np.array(others)):
        ends = find_attractors(
            amplitude, ratio, restitution, angle=points[:, 0], velocity=points[:, 1], phase=phase
        )
        falls.append(ends.are(AttractorKind.OVERTURNED))
    assert len(ones) > 100
    assert (falls[0] != falls[1]).all()


def test_the_border_of_a_picture_of_basins_is_the_stable_manifold() -> None:
    block = DimensionlessBlock(restitution=0.88)
    motion = Harmonic(amplitude=0.25, frequency_ratio=2.2, phase=0.7)
    axis = np.linspace(-1.05, 1.05, 60)
    basins = compute_basins(block, motion, angles=axis, velocities=axis)
    manifolds = [
        compute_manifold(saddle, "stable", length=8.0)
        for saddle in find_hilltop_saddles(block, motion)
    ]
    fallen = next(each.label for each in basins.attractors if each.kind == "overturned")
    falls = basins.label == fallen
    cell = axis[1] - axis[0]
    rows, columns = np.nonzero(falls[:, :-1] != falls[:, 1:])
    assert len(rows) > 40
    for row, column in zip(rows.tolist(), columns.tolist(), strict=True):
        angle, velocity = 0.5 * (axis[column] + axis[column + 1]), axis[row]
        if abs(angle) < cell:  # the flow jumps at an impact, and so does the border
            continue
        nearest = min(
            math.dist((angle, velocity), found.nearest(angle, velocity)) for found in manifolds
        )
        assert nearest <= 0.5001 * cell


def gap(block: DimensionlessBlock, amplitude: float, ratio: float, leaves: int) -> float:
    """Return by how much, at least, motions that leave one hilltop fall short of the other."""
    motion = Harmonic(amplitude=amplitude, frequency_ratio=ratio)
    saddles = {saddle.side: saddle for saddle in find_hilltop_saddles(block, motion)}

    def speeds(found: Manifold, sign: int) -> CubicSpline:
        # The branch that comes to the base, a closed curve over the phase.
        branch = next(each for each in found.branches if each.sign == sign)
        assert branch.ended == "whole"
        order = np.argsort(branch.first)
        x, y = branch.first[order], branch.second[order]
        keep = np.concatenate([[True], np.diff(x) > 1e-9])
        x, y = x[keep], y[keep]
        return CubicSpline(np.append(x, x[0] + TURN), np.append(y, y[0]), bc_type="periodic")

    options = {"over": "impacts", "spacing": 0.003}
    out = speeds(compute_manifold(saddles[leaves], "unstable", **options), -leaves)  # type: ignore[arg-type]
    into = speeds(compute_manifold(saddles[-leaves], "stable", **options), leaves)  # type: ignore[arg-type]
    phases = np.linspace(0.0, TURN, 2000)
    short = into(phases) - out(phases)
    best = phases[int(np.argmin(short))]
    found = minimize_scalar(
        lambda psi: float(into(psi) - out(psi)), bracket=(best - 0.05, best, best + 0.05)
    )
    return float(found.fun)


@pytest.mark.slow
@every(("ratio", "restitution"), [(2.0, 0.9), (1.0, 0.85), (4.0, 0.95)])
def test_manifolds_of_both_hilltops_touch_at_the_heteroclinic_amplitude(
    ratio: float, restitution: float
) -> None:
    block = DimensionlessBlock(restitution=restitution)
    touching = float(heteroclinic_amplitude(ratio, restitution))  # Hogan (1992)
    assert gap(block, touching, ratio, 1) == pytest.approx(0.0, abs=1e-8)
    assert gap(block, 0.98 * touching, ratio, 1) > 1e-3 * (1.0 - restitution)
    assert gap(block, 1.02 * touching, ratio, -1) < -1e-3 * (1.0 - restitution)


def test_they_touch_of_a_block_with_different_sides_too() -> None:
    block = DimensionlessBlock(restitution=0.9, alpha_ratio=1.1)
    touching = tangency_amplitude(block.sides, 2.0)
    gaps = [gap(block, touching, 2.0, side) for side in (1, -1)]
    assert min(map(abs, gaps)) == pytest.approx(0.0, abs=1e-8)


@pytest.mark.slow
def test_manifolds_of_an_orbit_over_impacts_begin_at_its_states() -> None:
    saddle = saddle_orbit()
    found = compute_manifold(saddle, "unstable", over="impacts", length=1.0)
    assert [(each.sign, each.place) for each in found.branches] == [
        (1, 0),
        (1, 1),
        (-1, 0),
        (-1, 1),
    ]
    entering = compute_manifold(saddle, "stable", over="impacts", length=1.0)
    for branch in (*found.branches, *entering.branches):
        state = saddle.states[branch.place]
        assert branch.first[0] == pytest.approx(state.phase, abs=3e-6)
        assert branch.second[0] == pytest.approx(state.speed, abs=3e-6)
        assert branch.side[0] == state.side
    # They settle on the stable orbits beside it, which are mirror images.
    assert {branch.ended for branch in found.branches} == {"settled"}
    stable = next(orbit for orbit in find_orbits(BARE, SHAKEN, max_period=1) if orbit.stable)
    for branch in found.branches:
        ends = [
            abs(state.speed - branch.second[-1])
            for state in (*stable.states, *stable.mirrored.states)
        ]
        assert min(ends) < 1e-3


def test_a_longer_branch_contains_a_shorter_one() -> None:
    motion = Harmonic(amplitude=0.5, frequency_ratio=2.0)
    saddle = hilltop(DimensionlessBlock(restitution=0.9), motion, Linear())
    short, long = (compute_manifold(saddle, "unstable", length=size) for size in (2.0, 6.0))
    one, other = short.branches[1], long.branches[1]
    assert isinstance(one, ManifoldBranch)
    assert other.length > one.length
    count = int(np.searchsorted(one.label, 2.0))
    assert (other.first[:count] == one.first[:count]).all()


def placed(first: Floats, second: Floats | float = 0.0) -> Images:
    none = np.zeros(len(first), dtype=np.int64)
    return Images(first, np.broadcast_to(second, first.shape).copy(), none, none + 1, none > 0)


def test_a_branch_is_broken_where_its_samples_are() -> None:
    plane = Plane(np.zeros(2), np.ones(2), 0.0)
    for count, breaks in ((5, []), (5, [0]), (5, [2]), (5, [3]), (5, [0, 3]), (2, []), (1, [])):
        first = 0.2 * np.arange(float(count), dtype=np.float64)
        part = Sampled(first, placed(first), np.isin(np.arange(count - 1), breaks), True)
        found = _branch(part, plane, 1, 0, "length")
        assert found.breaks.tolist() == breaks
        assert found.length == pytest.approx(0.2 * (count - 1 - len(breaks)))
        assert len(found.arclength) == count


def test_a_branch_over_impacts_is_as_long_as_the_shortest_way_round() -> None:
    plane = Plane(np.zeros(2), np.ones(2), TURN)
    first = np.array([6.0, 6.2, 0.1, 0.3, 6.1])
    part = Sampled(first, placed(first), np.zeros(4, bool), True)
    found = _branch(part, plane, -1, 2, "whole")
    ahead = TURN - 6.2 + 0.1
    expected = np.cumsum([0.0, 0.2, ahead, 0.2, TURN - 6.1 + 0.3])
    np.testing.assert_allclose(found.arclength, expected, rtol=1e-12)
    assert (found.sign, found.place, found.ended) == (-1, 2, "whole")


def test_points_beyond_one_and_a_fifth_of_the_window_are_left_out_and_break_a_branch() -> None:
    plane = Plane(np.array([0.5, 0.0]), np.array([1.0, 2.0]), 0.0)
    first = np.array([-0.8, -0.6, 0.0, 1.6, 1.8, 1.6, 1.5, 1.5])
    second = np.array([0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 2.3, 2.5])
    part = Sampled(first, placed(first, second), np.zeros(7, bool), True)
    found = _branch(part, plane, 1, 0, "far")
    assert found.first.tolist() == [-0.6, 0.0, 1.6, 1.6, 1.5]
    assert found.label.tolist() == found.first.tolist()
    assert found.breaks.tolist() == [2]
    assert found.length == pytest.approx(0.6 + 1.6 + math.hypot(0.1, 2.3))


def test_a_branch_ends_by_its_length_or_where_its_last_period_is_nothing_new() -> None:
    plane = Plane(np.zeros(2), np.ones(2), 0.0)
    labels = np.linspace(0.0, 3.0, 31)
    whole = np.ones(30, bool)

    def ended(
        first: Floats,
        *,
        label: float = 3.0,
        length: float = 9.0,
        fallen: bool = False,
        broken: NDArray[np.bool_] = ~whole,
    ) -> str:
        images = placed(first)._replace(fallen=np.full(31, fallen))
        return _end_of(Sampled(labels, images, broken, True), plane, label, length, 0.1)

    even = 0.3 * labels
    assert ended(even) == ""
    assert ended(even, length=0.9 - 1e-12) == "length"
    assert ended(even, length=0.9 + 1e-12) == ""
    assert ended(even, length=0.5, broken=whole) == ""
    out = np.where(labels > 1.95, 3.0, 0.1 * labels)
    assert (ended(out, fallen=True), ended(out)) == ("far", "rest")
    assert ended(out, label=1.9, fallen=True) == ""
    stays = np.where(labels > 1.95, 0.2, 0.1 * labels)
    assert ended(stays) == "rest"
    # Each period is 1/20, or 1/200, of the one before: below 0.001 nothing is left to come.
    for share, word in ((20.0, ""), (200.0, "settled")):
        assert ended(0.5 * share**-labels) == word
    assert ended(1e-8 * share**labels, length=1.0) == ""
    # A piece that leaves the window and comes back counts inside alone.
    aside = np.where((labels > 0.95) & (labels < 1.15), 1.5, even)
    kept_steps = 0.9 - 0.03 * 3
    assert ended(aside, length=kept_steps - 1e-9) == "length"
    assert ended(aside, length=kept_steps + 1e-9) == ""
    gone = np.full(31, 3.0)
    assert (ended(gone, label=1.95, fallen=True), ended(gone, label=2.0, fallen=True)) == (
        "",
        "far",
    )
    assert ended(np.where(labels > 2.0, 3.0, 0.1 * labels), fallen=True) != "far"


@every(
    ("steps", "word"),
    [
        ({5: 5e-4, 15: 1e-4, 25: 2e-4}, ""),
        ({10: 5e-4, 15: 1e-4, 25: 2e-4}, ""),
        ({5: 1e-4, 20: 3e-4, 25: 2e-4}, "settled"),
        ({5: 1e-4, 11: 3e-4, 21: 2e-4}, "settled"),
        ({15: 3e-4, 25: 3e-4}, ""),
        ({15: 3e-2, 25: 9e-4}, "settled"),
        ({15: 3e-2, 25: 1.1e-3}, ""),
    ],
)
def test_a_branch_has_settled_where_a_period_is_short_and_shorter_than_the_one_before(
    steps: dict[int, float], word: str
) -> None:
    # Step k ends at the label k/10; periods are those up to 1, up to 2 and up to 3.
    first = np.cumsum([steps.get(k, 0.0) for k in range(31)])
    part = Sampled(np.linspace(0.0, 3.0, 31), placed(first), np.zeros(30, bool), True)
    assert _end_of(part, Plane(np.zeros(2), np.ones(2), 0.0), 3.0, 9.0, 0.1) == word


def test_the_nearest_point_of_a_manifold_is_that_of_a_fine_polyline() -> None:
    rng = np.random.default_rng(4)
    x, y = rng.uniform(-1.0, 1.0, (2, 12))
    x[6], y[6] = x[5], y[5]
    plane = Plane(np.zeros(2), np.full(2, 4.0), 0.0)
    # Pieces of one point, of six with one that stands twice, of two, and of three.
    broken = np.isin(np.arange(11), [0, 6, 8])
    part = Sampled(np.arange(12.0), placed(x, y), broken, True)
    lone = Sampled(np.zeros(1), placed(x[:1], y[:1] + 2.0), np.zeros(0, bool), True)
    saddle = hilltop(BARE, SHAKEN, Linear())
    branches = tuple(_branch(each, plane, 1, 0, "length") for each in (part, lone))
    found = Manifold(
        saddle=saddle, kind="stable", over="phase", phase=0.0,
        branches=branches, window=(4.0, 4.0), spacing=0.1,
    )  # fmt: skip
    share = np.linspace(0.0, 1.0, 2001)[:, np.newaxis]
    chords = [np.column_stack([x, y])[k] * (1.0 - share) + share * np.column_stack([x, y])[k + 1]
              for k in np.flatnonzero(~broken)]  # fmt: skip
    fine = np.concatenate([*chords, [[x[0], y[0]], [x[0], y[0] + 2.0]]])
    assert found.points == 13
    for u, v in [*rng.uniform(-1.5, 3.0, (40, 2)).tolist(), (x[0] + 0.01, y[0]), (x[5], y[5])]:
        nearest = math.dist(found.nearest(u, v), (u, v))
        least = np.hypot(*(fine - (u, v)).T).min()
        assert nearest <= least + 1e-12
        assert nearest == pytest.approx(least, abs=1e-3)
    refused: list[tuple[dict[str, Any], str]] = [
        ({"over": "impacts"}, "over impacts"),
        ({"branches": ()}, "no points"),
    ]
    for changed, words in refused:
        with pytest.raises(ModelError, match=words):
            replace(found, **changed).nearest(0.0, 0.0)


def test_what_has_no_manifolds_is_refused() -> None:
    orbits = find_orbits(BARE, SHAKEN, max_period=1, seeds=12)
    stable = next(orbit for orbit in orbits if orbit.stable)
    with pytest.raises(ModelError, match="one above 1 and one below"):
        compute_manifold(stable, "stable")
    through = next(orbit for orbit in orbits if not orbit.admissible)
    with pytest.raises(ModelError, match="passes through the floor"):
        compute_manifold(through, "stable")
