"""Shares over a parameter: those of each value alone, and families that are continued orbits."""

import math
from typing import Any

import numpy as np
import pytest

from rocksteady import (
    Block,
    DimensionlessBlock,
    Execution,
    Harmonic,
    Nonlinear,
    Store,
    compute_basins,
    find_orbits,
)
from rocksteady.basins import (
    BasinShares,
    MatchingOptions,
    SamplingOptions,
    compute_basin_shares,
    compute_uncertainty_exponent,
)
from rocksteady.errors import InputError, ModelError
from rocksteady.formulas import steady_states
from rocksteady.orbits import Orbit, sweep_attractor
from rocksteady.outcomes import AttractorKind
from tests.dynamics.kicks import apart
from tests.every import every

WINDOW = np.linspace(-1.2, 1.2, 24)
BREAKING = np.linspace(1.85, 2.05, 9)
"""Frequency ratios around a symmetry breaking at A = 2, restitution 0.8."""


def sampling(seed: int | None = 1, count: int = 24, **more: Any) -> SamplingOptions:
    window = np.linspace(-1.2, 1.2, count)
    return SamplingOptions(**{"angles": window, "velocities": window, "seed": seed} | more)


def broken(values: Any = BREAKING, **more: Any) -> BasinShares:
    return compute_basin_shares(
        DimensionlessBlock(restitution=0.8),
        Harmonic(amplitude=2.0, frequency_ratio=1.0),
        "frequency_ratio",
        values,
        **{"sampling": sampling(), **more},
    )


def same(one: Orbit | None, other: Orbit | None, within: float = 1e-9) -> bool:
    if one is None or other is None:
        return one is other
    near = min(apart(one.states[0], state) for state in other.states)
    return one.period == other.period and len(one.states) == len(other.states) and near < within


ASYMMETRIC = Block.asymmetric(left=0.15, right=0.25, height=1.2, restitution=0.9)
CASES: list[tuple[Any, ...]] = [
    (DimensionlessBlock(restitution=0.95), (0.5, 2.0), "frequency_ratio", [1.9, 2.0, 2.1], {}),
    (DimensionlessBlock(restitution=0.9), (0.5, 4.0), "amplitude", [0.0, 0.6, 1.2], {}),
    (DimensionlessBlock(restitution=0.9), (1.5, 4.0), "restitution", [0.98, 0.9, 0.7], {}),
    (DimensionlessBlock(restitution=0.95), (0.5, 2.0), "phase", [-0.5, 3.0, 6.5], {}),
    (ASYMMETRIC, (0.6, 3.0), "amplitude", [0.5, 0.7], {}),
    (
        Block.from_radius(alpha=0.3, radius=1.0, restitution=0.9),
        (1.5, 4.0),
        "frequency_ratio",
        [3.9, 4.1],
        {"model": Nonlinear()},
    ),
]


@every(("block", "point", "parameter", "values", "more"), CASES)
@every("seed", [None, 3])
def test_shares_at_a_value_are_those_of_its_basins(
    block: Any, point: Any, parameter: str, values: Any, more: Any, seed: int | None
) -> None:
    motion = Harmonic(amplitude=point[0], frequency_ratio=point[1], phase=0.4)
    how = sampling(seed, 14, max_cycles=100)
    found = compute_basin_shares(block, motion, parameter, values, sampling=how, **more)
    np.testing.assert_allclose(found.share.sum(axis=0), 1.0, rtol=1e-14)
    for place in range(len(values)):
        body, moved = found.case(place)
        alone = compute_basins(
            body,
            moved,
            angles=how.angles,
            velocities=how.velocities,
            seed=seed,
            max_cycles=100,
            **more,
        )
        there = [one for one in found.families if one.present[place]]
        of = {
            attractor.label: next(
                one.label
                for one in there
                if (here := one.attractors[place]) is not None
                and here.kind is attractor.kind
                and same(here.orbit, attractor.orbit)
            )
            for attractor in alone.attractors
        }
        assert len(set(of.values())) == len(of)
        np.testing.assert_array_equal(np.vectorize(of.get)(alone.label), found.label[place])
        seeded = [one for one in there if one.label not in of.values()]
        assert all(found.states[one.label, place] == 0 for one in seeded)


def test_against_a_wall() -> None:
    block = DimensionlessBlock(restitution=0.6, one_sided=True)
    motion = Harmonic(amplitude=1.0, frequency_ratio=4.0)
    found = compute_basin_shares(
        block,
        motion,
        "restitution",
        [0.0, 0.4, 0.6],
        sampling=SamplingOptions(seed=1, max_cycles=50),
    )
    alone = compute_basins(
        block, motion, angles=found.angle, velocities=found.velocity, seed=1, max_cycles=50
    )
    assert sorted(found.states[found.states[:, 2] > 0, 2].tolist()) == sorted(alone.states.tolist())
    assert (found.angle > 0.0).all()


def test_a_family_is_the_continued_orbit_and_that_of_the_closed_form() -> None:
    values = np.linspace(2.0, 2.4, 9)
    found = broken(values)
    (family,) = (one for one in found.families if one.name == "symmetric-1")
    block, first = found.case(0)
    (origin,) = (orbit for orbit in find_orbits(block, first, max_period=1) if orbit.stable)
    swept = sweep_attractor(block, first, "frequency_ratio", values, start=origin.states[0])
    for value, mine, theirs in zip(values, family.orbits, swept.attractors, strict=True):
        assert same(mine, theirs.orbit)
        assert mine is not None
        states = steady_states(2.0, float(value), 0.8)
        speeds = states.velocity[states.stable]
        assert mine.states[0].speed == pytest.approx(speeds[0], rel=1e-9)


def test_at_a_symmetry_breaking_one_image_goes_on_with_the_label() -> None:
    found = broken()
    names = [one.name for one in found.families]
    assert names == ["overturned", "symmetric-1", "unsymmetric-1"]
    whole, born = found.families[1:]
    assert whole.present.all()
    split = born.present
    assert 2 < split.sum() < len(BREAKING)
    assert (found.share[2, ~split] == 0.0).all()
    for one, other, both in zip(whole.orbits, born.orbits, split, strict=True):
        assert one is not None
        assert one.symmetric != both
        assert other is None or same(one.mirrored, other)
    # No image changes sides.
    leans = [one.highest > -one.lowest for one in born.orbits if one is not None]
    assert len(set(leans)) == 1


def test_mirror_images_have_each_others_share_half_a_period_later() -> None:
    block, motion = (
        DimensionlessBlock(restitution=0.8),
        Harmonic(amplitude=2.0, frequency_ratio=1.9),
    )
    phases = [0.3, 1.0, 0.3 + math.pi, 1.0 + math.pi]
    found = compute_basin_shares(block, motion, "phase", phases, sampling=sampling(None, 40))
    first, second = (one.label for one in found.families if one.typical.orbit is not None)
    assert found.states[first, :2].tolist() == found.states[second, 2:].tolist()
    assert found.states[second, :2].tolist() == found.states[first, 2:].tolist()
    assert found.states[0, :2].tolist() == found.states[0, 2:].tolist()
    assert all(same(orbit, found.families[1].orbits[0]) for orbit in found.families[1].orbits)


@pytest.mark.parametrize("values", [BREAKING, np.linspace(1.75, 1.9, 6)])
def test_values_in_reverse_give_the_same_families(values: Any) -> None:
    forth, back = broken(values), broken(values[::-1])
    assert len(forth.families) == len(back.families)
    states = {tuple(row) for row in forth.states.tolist()}
    assert states == {tuple(row[::-1]) for row in back.states.tolist()}
    assert sorted(one.name for one in forth.families) == sorted(one.name for one in back.families)


def test_a_small_basin_is_found_from_its_neighbours() -> None:
    # A dozen states at each value hit the subharmonic of one value in fifty or not at all.
    block, motion = DimensionlessBlock(restitution=0.9), Harmonic(amplitude=1.0, frequency_ratio=4)
    values = np.linspace(0.8, 1.6, 9)
    found = compute_basin_shares(block, motion, "amplitude", values, sampling=sampling(2, 8))
    (third,) = (one for one in found.families if one.name == "symmetric-3")
    assert third.present.all()
    assert (found.share[third.label] == 0.0).any()
    assert "Share 0" in found.summary(more=True)
    large = compute_basin_shares(block, motion, "amplitude", values[:2], sampling=sampling(2, 30))
    assert (large.states > 0).all()
    assert "Share 0" not in large.summary(more=True)
    for value, orbit in zip(values, third.orbits, strict=True):
        assert orbit is not None
        assert orbit.stable
        assert orbit.motion.amplitude == value


def test_a_threshold_of_nothing_renames_and_vanished_ones_come_back() -> None:
    tight = broken(matching=MatchingOptions(threshold=1e-6))
    assert all(one.present.sum() == 1 for one in tight.families if one.typical.orbit is not None)
    assert tight.families[0].present.all()
    motion = Harmonic(amplitude=0.5, frequency_ratio=1.0)
    there_and_gone = [1.69231, 1.73, 2.0, 2.36, 2.38462]
    kept, forgotten = (
        compute_basin_shares(
            DimensionlessBlock(restitution=0.95),
            motion,
            "frequency_ratio",
            there_and_gone,
            sampling=sampling(1, 60),
            matching=MatchingOptions(threshold=math.inf, vanished=vanished),
        )
        for vanished in (True, False)
    )
    assert len(kept.families) < len(forgotten.families)


def test_rest_ends_at_uplift_and_a_still_base_knows_rest_and_falls() -> None:
    found = compute_basin_shares(
        DimensionlessBlock(restitution=0.9),
        Harmonic(amplitude=1.0, frequency_ratio=4.0),
        "amplitude",
        [0.0, 0.9, 1.1],
        sampling=sampling(count=40),
    )
    by_kind = {one.typical.kind: one for one in found.families if one.typical.orbit is None}
    assert by_kind[AttractorKind.REST].present.tolist() == [True, True, False]
    assert by_kind[AttractorKind.OVERTURNED].present.all()
    still = [one for one in found.families if one.present[0]]
    assert {one.typical.kind for one in still} == {AttractorKind.REST, AttractorKind.OVERTURNED}


@pytest.mark.slow
def test_a_store_and_another_executor_give_the_same(tmp_path: Any) -> None:
    path = tmp_path / "shares.zarr"
    first = broken(run=Execution(store=path, executor="serial"))
    again = broken(run=Execution(store=Store(path, resume=True)))
    np.testing.assert_array_equal(first.label, again.label)
    np.testing.assert_array_equal(first.label, broken().label)
    assert [one.name for one in first.families] == [one.name for one in again.families]


def test_a_result_keeps_and_shows_what_it_holds() -> None:
    found = broken(BREAKING[:3])
    data = found.to_dataset()
    assert data.share.dims == ("family", "frequency_ratio")
    np.testing.assert_array_equal(data.share.values, found.share)
    np.testing.assert_array_equal(data.label.values, found.label)
    assert data.label.attrs["flag_meanings"].split() == [one.name for one in found.families]
    assert "frequency_ratio" not in data.attrs
    frame = found.to_dataframe()
    assert frame.groupby("frequency_ratio")["share"].sum().tolist() == pytest.approx([1.0] * 3)
    assert len(repr(found)) < 100
    entropy = found.entropies(4)
    assert entropy.entropy.shape == (3,)
    exponent = compute_uncertainty_exponent(found.label[0], [1, 2, 3])
    assert 0.0 < exponent.exponent < 1.2
    block = Block.from_radius(alpha=0.3, radius=1.0, restitution=0.9)
    motion = Harmonic(amplitude=1.0, frequency_ratio=4.0)
    along = compute_basin_shares(block, motion, "restitution", [0.8, 0.9], sampling=sampling())
    assert "restitution 0.9" not in along.describe().headline
    assert along.to_dict()["block"]["alpha_rad"] == 0.3


@every(
    ("parameter", "values", "says"),
    [
        ("slenderness", [1.0, 2.0], "name one of them"),
        ("amplitude", [], "ascends or descends"),
        ("amplitude", [1.0, 3.0, 2.0], "ascends or descends"),
        ("amplitude", [1.0, 1.0], "ascends or descends"),
        ("amplitude", [[1.0, 2.0]], "ascends or descends"),
        ("amplitude", [-1.0, 1.0], "amplitude"),
        ("restitution", [0.5, 1.5], "restitution"),
        ("phase", [0.0, math.inf], "phase|values"),
    ],
)
def test_bad_input_is_refused(parameter: str, values: Any, says: str) -> None:
    block, motion = DimensionlessBlock(restitution=0.9), Harmonic(amplitude=1.0, frequency_ratio=4)
    with pytest.raises(InputError, match=says):
        compute_basin_shares(block, motion, parameter, values)


def test_the_nonlinear_model_needs_a_block_and_a_window_of_many_states() -> None:
    block, motion = DimensionlessBlock(restitution=0.9), Harmonic(amplitude=1.0, frequency_ratio=4)
    with pytest.raises(ModelError):
        compute_basin_shares(block, motion, "amplitude", [1.0], model=Nonlinear())
    with pytest.raises(InputError, match="angles"):
        compute_basin_shares(
            block, motion, "amplitude", [1.0], sampling=SamplingOptions(angles=[0.0])
        )
    with pytest.raises(InputError, match="seed"):
        SamplingOptions(seed=-1)
    with pytest.raises(InputError, match="max_cycles"):
        SamplingOptions(max_cycles=0)
