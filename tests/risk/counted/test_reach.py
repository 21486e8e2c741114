"""Levels that reach by themselves: exact thresholds against runs beside them, and both ends."""

import math
from collections.abc import Sequence

import numpy as np
import pytest

from rocksteady import BaseMotion, Block, Record, Status, compute_fragility, run_ensemble
from rocksteady.errors import InputError
from rocksteady.motions import Floor, make_synthetic_suite
from rocksteady.risk import Levels, RestitutionBand, Ways
from rocksteady.risk.counted.motions import Motion
from rocksteady.risk.counted.reach import lifting_levels, reaching_levels
from rocksteady.risk.counted.suite import Suite
from tests.risk.counted.recorded import RACKS, real_pairs, real_suite

SUITE = make_synthetic_suite(6, seed=2)
PAIRS: list[Motion] = [
    BaseMotion(one, other.scaled(0.7)) for one, other in zip(SUITE, reversed(SUITE), strict=True)
]
RACK = Block.rectangle(width=0.6, height=2.0)
ASIDE = Block.asymmetric(left=0.25, right=0.4, height=2.4)
ONE = RestitutionBand(draws=1)
PGA = Levels("pga_g", beside=())


def lifted_beside(
    block: Block, motions: Sequence[Motion], ways: Ways | None, part: float
) -> np.ndarray:
    """Return which runs lift where each motion is scaled to its own threshold, a little aside."""
    at = lifting_levels(PGA, [block], motions, ways=ways)[0]
    lifted = np.empty((2, *at.shape), dtype=bool)
    for place, motion in enumerate(motions):
        each = np.unique(at[place])
        levels = np.sort(np.concatenate([each * (1.0 - part), each * (1.0 + part)]))
        runs = run_ensemble(
            block, [motion], levels=Levels("pga_g", levels, beside=()), restitution=ONE, ways=ways
        )
        peaks = runs["peak_angle"].isel(block=0, record=0, draw=0).transpose(
            "direction", "vertical", "level"
        )  # fmt: skip
        for row, sign in enumerate((1.0 - part, 1.0 + part)):
            below = np.searchsorted(levels, at[place] * sign * (1.0 - 1e-12))
            taken = np.take_along_axis(peaks.values, below[..., np.newaxis], axis=-1)
            lifted[row, place] = taken[..., 0] > 0.0
    return lifted


@pytest.mark.parametrize(
    ("block", "motions", "ways"),
    [
        (RACK, SUITE, None),
        (ASIDE, SUITE, None),
        (ASIDE.against_wall(0.4), SUITE, None),
        (RACK, PAIRS, Ways(vertical=True)),
        (ASIDE, PAIRS, Ways(vertical="both")),
        (RACK, Suite(motions=PAIRS), Ways(vertical=True)),
    ],
    ids=["ground", "aside", "wall", "vertical", "both", "floor"],
)
def test_below_its_threshold_none_lifts_and_above_it_every_run_does(
    block: Block, motions: Sequence[Motion] | Suite, ways: Ways | None
) -> None:
    if isinstance(motions, Suite):
        motions = [Floor(**RACKS).motion(each) for each in motions.motions]
    below, above = lifted_beside(block, motions, ways, 1e-7)
    assert not below.any()
    assert above.all()


@pytest.mark.parametrize("floor", [None, Floor(**RACKS)], ids=["ground", "floor"])
def test_none_of_the_real_records_lifts_below_its_threshold_and_all_do_above(
    floor: Floor | None,
) -> None:
    motions = [*real_suite()] if floor is None else [floor.motion(each) for each in real_suite()]
    below, above = lifted_beside(RACK, motions, None, 1e-7)
    assert not below.any()
    assert above.all()


def test_of_real_records_with_a_vertical_one_the_threshold_is_exact_too() -> None:
    below, above = lifted_beside(RACK, real_pairs(), Ways(vertical=True), 1e-7)
    assert not below.any()
    assert above.all()


@pytest.mark.parametrize("kind", ["ground", "floor", "vertical", "aside"])
def test_the_exact_step_is_the_share_of_the_runs_that_lift_at_every_level(kind: str) -> None:
    floor, ways, block = Floor(**RACKS), Ways(), RACK
    motions: list[Motion] = [*real_suite()]
    if kind == "floor":
        motions = [floor.motion(each) for each in motions]
    elif kind == "vertical":
        motions, ways = [*real_pairs()], Ways(vertical=True)
    elif kind == "aside":
        block = ASIDE
    at = np.unique(lifting_levels(PGA, [block], motions, ways=ways))
    levels = Levels("pga_g", np.geomspace(0.8 * at[0], 1.2 * at[-1], 20), beside=())
    found = compute_fragility(block, motions, levels=levels, restitution=ONE, ways=ways)
    uplift = found.state("uplift")
    np.testing.assert_allclose(uplift.curve.shares, uplift.share(uplift.curve.levels), atol=1e-15)
    assert uplift.curve.shares[0] == 0.0
    if kind != "vertical":
        assert uplift.curve.shares[-1] == 1.0
    assert len(np.unique(uplift.curve.shares)) > {"ground": 1, "vertical": 3}.get(kind, 5)


def reached(motions: Sequence[Motion], block: Block = RACK, **how: object) -> np.ndarray:
    found = reaching_levels(PGA, [block], motions, restitution=ONE, **how)  # type: ignore[arg-type]
    return np.asarray(found.levels)


def outcomes(
    levels: np.ndarray, motions: Sequence[Motion], ways: Ways | None = None
) -> tuple[np.ndarray, np.ndarray]:
    """Return share that falls, of the runs with an answer, and share of runs without one."""
    runs = run_ensemble(
        RACK,
        motions,
        levels=Levels("pga_g", levels, beside=()),
        restitution=ONE,
        ways=Ways(reverse=False) if ways is None else ways,
    )
    status = runs["status"].transpose("level", ...).values.reshape(len(levels), -1)
    lost = ~np.isin(status, [Status.AT_REST, Status.ROCKING, Status.OVERTURNED])
    fell = (status == Status.OVERTURNED).sum(axis=1) / np.maximum(1, (~lost).sum(axis=1))
    return fell, lost.mean(axis=1)


def test_levels_rise_in_equal_ratios_from_the_lowest_uplift_to_where_nearly_all_fall() -> None:
    """18 of 20 fall where levels could have ended, and go on; 19 of 20 are enough."""
    suite = make_synthetic_suite(20, seed=6)
    levels = reached(suite)
    slope = math.tan(RACK.alpha)
    assert levels[0] == pytest.approx(slope, rel=2e-6)
    assert levels[0] < slope
    np.testing.assert_allclose(levels[1:] / levels[:-1], 64.0 ** (1.0 / 32.0), rtol=1e-12)
    assert len(levels) % 4 == 1
    shares, without = outcomes(levels, suite)
    assert shares[0] == 0.0
    assert shares[4:-4:4].max() == pytest.approx(0.9)  # where an end was looked for before
    assert shares[-1] == pytest.approx(0.95)
    assert without.max() == 0.0


def test_where_runs_lose_their_answers_levels_end() -> None:
    """A base that falls at g: one run in a hundred is enough."""
    ways = Ways(vertical=True, reverse=False)
    levels = reached(PAIRS, ways=ways)
    shares, without = outcomes(levels, PAIRS, ways)
    assert without[-1] > 0.01
    assert (without[4:-4:4] <= 0.01).all()
    assert shares[-1] < 0.95
    found = compute_fragility(RACK, PAIRS, levels=PGA, restitution=ONE, ways=ways)
    kept = found.states[-1].curve.levels
    assert (outcomes(kept, PAIRS, ways)[1] <= 0.01).all()
    assert 0 < len(kept) < len(levels)
    assert any("more than 1% of the runs have no answer" in each for each in found.warnings)


def test_a_block_that_hardly_falls_has_levels_up_to_64_times_the_first() -> None:
    """A monument of 40 m under shaking of 50 Hz."""
    block = Block.rectangle(width=12.5, height=40.5)
    quick = [Record(acceleration_m_s2=each.acceleration_m_s2, dt_s=1e-3) for each in SUITE[:2]]
    levels = reached(quick, block)
    assert len(levels) == 33
    assert levels[-1] / levels[0] == pytest.approx(64.0)


def test_levels_of_a_demand_are_among_them_and_no_other_changes() -> None:
    plain = reached(SUITE)
    beside = (0.5 * plain[0], 0.4, 0.44, 3.0 * plain[-1])
    levels = reached(SUITE, also=beside)
    assert levels.tolist() == sorted({*plain.tolist(), *beside})
    assert reached(SUITE, also=(0.4, 0.4, float(plain[3]))).tolist() == sorted(
        {*plain.tolist(), 0.4}
    )


def test_there_is_no_level_beyond_the_most() -> None:
    plain = reached(SUITE)
    most = float(0.5 * (plain[6] + plain[7]))
    assert reached(SUITE, most=most).tolist() == plain[:7].tolist()
    assert reached(SUITE, most=float(plain[4])).tolist() == plain[:5].tolist()


def test_levels_that_are_given_stay_and_the_measure_is_kept() -> None:
    given = Levels("pgv_m_s", [0.2, 0.3])
    assert reaching_levels(given, [RACK], SUITE) is given
    velocity = reaching_levels(Levels("pgv_m_s"), [RACK], SUITE, restitution=ONE)
    assert velocity.key == "pgv_m_s"
    assert len(velocity.beside) > 0
    at = lifting_levels(Levels("pgv_m_s"), [RACK], SUITE)
    assert np.asarray(velocity.levels)[0] == pytest.approx(at.min(), rel=2e-6)


def test_several_blocks_begin_where_the_first_lifts() -> None:
    levels = reaching_levels(PGA, [RACK, ASIDE], SUITE, restitution=ONE)
    both = lifting_levels(PGA, [RACK, ASIDE], SUITE)
    assert both.shape[:2] == (2, len(SUITE))
    assert np.asarray(levels.levels)[0] == pytest.approx(both.min(), rel=2e-6)


def test_motions_that_never_lift_it_are_refused_in_one_line() -> None:
    """A wall behind it, and a base that only moves towards the wall."""
    push = Record(acceleration_m_s2=np.array([0.0, -2.0, 0.0]), dt_s=0.1)
    wall = RACK.against_wall(0.4)
    with pytest.raises(InputError, match="motions never lift it") as error:
        reaching_levels(PGA, [wall], [push] * 3, ways=Ways(reverse=False))
    assert "\n" not in str(error.value)
    (one, other) = lifting_levels(PGA, [wall], [push])[0, 0, :, 0]
    assert one == math.inf
    assert other == pytest.approx(math.tan(RACK.alpha))
