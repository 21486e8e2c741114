"""Counts: shares of records with an answer, against runs counted one by one."""

import itertools
import math

import numpy as np
import pytest
import xarray

from rocksteady import Block, Status, run_ensemble
from rocksteady.motions import make_synthetic_suite
from rocksteady.risk import Levels, RestitutionBand, Ways
from rocksteady.risk.counted.count import ANSWERS, count_falls, counts_of, outcomes_of
from tests.risk.counted.recorded import count_of

SUITE = make_synthetic_suite(3)
SYMMETRIC = Block.rectangle(width=0.4, height=1.6)
ASIDE = Block.asymmetric(left=0.25, right=0.4, height=2.4)
STATUSES = [int(status) for status in Status]


def ensemble_of(*blocks: Block) -> xarray.Dataset:
    """Return an ensemble whose outcomes are drawn: every status there is, with peaks."""
    runs = run_ensemble(
        list(blocks),
        SUITE,
        levels=Levels("pga_g", [0.3, 0.6], beside=()),
        restitution=RestitutionBand(draws=2),
    ).copy(deep=True)
    random = np.random.default_rng(3)
    runs["status"].values[:] = random.choice(STATUSES, runs["status"].shape)
    runs["peak_angle"].values[:] = random.uniform(0.0, 2.0, runs["status"].shape)
    return runs


def by_hand(runs: xarray.Dataset, directions: int) -> list[dict[str, list[int]]]:
    """Return falls and answers of each record at each level, run by run."""
    found = []
    for level in range(runs.sizes["level"]):
        fell, answered = [0] * len(SUITE), [0] * len(SUITE)
        for record, block, way, draw in itertools.product(
            range(len(SUITE)), range(runs.sizes["block"]), range(directions), range(2)
        ):
            status = int(
                runs["status"].isel(
                    record=record, block=block, direction=way, vertical=0, draw=draw, level=level
                )
            )
            fell[record] += status == Status.OVERTURNED
            answered[record] += status in (Status.ROCKING, Status.AT_REST, Status.OVERTURNED)
        found.append({"fell": fell, "answered": answered})
    return found


@pytest.mark.parametrize(
    ("blocks", "directions"),
    [((SYMMETRIC,), 1), ((ASIDE,), 2), ((SYMMETRIC, ASIDE), 2),
     ((SYMMETRIC.against_wall(0.4),), 2)],
)  # fmt: skip
def test_each_record_has_the_falls_of_its_runs_and_mirror_images_count_once(
    blocks: tuple[Block, ...], directions: int
) -> None:
    runs = ensemble_of(*blocks)
    ways = directions * len(blocks) * 2
    counts = count_falls(runs)
    expected = by_hand(runs, directions)
    assert len(counts) == 2
    for count, hand in zip(counts, expected, strict=True):
        assert count.fell.tolist() == hand["fell"]
        assert count.answered.tolist() == hand["answered"]
        assert count.ways == ways
        assert count.without == ways * len(SUITE) - sum(hand["answered"])
        shares = [f / a for f, a in zip(hand["fell"], hand["answered"], strict=True) if a]
        assert count.share == pytest.approx(math.fsum(shares) / len(shares), rel=1e-14)
        assert (count.falls, count.runs) == (sum(hand["fell"]), sum(hand["answered"]))


def test_the_order_of_the_dimensions_is_of_no_account() -> None:
    runs = ensemble_of(SYMMETRIC, ASIDE)
    turned = runs.transpose(*reversed(runs["status"].dims))
    for one, other in zip(outcomes_of(runs), outcomes_of(turned), strict=True):
        np.testing.assert_array_equal(one, other)
    for first, second in zip(count_falls(runs), count_falls(turned), strict=True):
        assert first.fell.tolist() == second.fell.tolist()


def test_one_sign_of_a_symmetric_block_is_all_of_it() -> None:
    levels, band = Levels("pga_g", [0.3, 0.6], beside=()), RestitutionBand(draws=2)
    one, both = (
        count_falls(
            run_ensemble(
                SYMMETRIC, SUITE, levels=levels, restitution=band, ways=Ways(reverse=reverse)
            )
        )
        for reverse in (False, "both")
    )
    for first, second in zip(one, both, strict=True):
        assert first.fell.tolist() == second.fell.tolist()
        assert first.ways == second.ways == 2


def test_only_resting_rocking_and_falling_are_answers() -> None:
    assert set(ANSWERS) == {Status.AT_REST, Status.ROCKING, Status.OVERTURNED}
    assert set(STATUSES) > {int(each) for each in ANSWERS}


def test_a_record_counts_as_one_however_many_of_its_runs_have_an_answer() -> None:
    """Two of two, none of four, and one without an answer: a half, not two in six."""
    count = count_of([2, 0, 0], 4, [2, 4, 0])
    assert (count.records, count.runs, count.falls, count.without) == (2, 6, 2, 6)
    assert count.share == 0.5
    assert count.band == count_of([4, 0], 4).band
    none = count_of([0, 0], 4, [0, 0])
    assert none.records == none.runs == 0
    assert math.isnan(none.share)
    assert none.band == (0.0, 1.0)


def test_a_part_of_the_records_is_counted_alone() -> None:
    count = count_of([5, 1, 0, 0], 5, [5, 5, 4, 5])
    part = count.among(np.array([True, False, True, False]))
    assert (part.records, part.falls, part.runs, part.without) == (2, 5, 9, 1)
    assert part.share == 0.5


def test_what_has_no_answer_may_have_fallen_or_stood() -> None:
    """All that is not known goes one way: its share is the least and the most there can be."""
    count = count_of([2, 0, 0], 4, [2, 4, 0])
    worst, best = count.if_they_fell(fell=True), count.if_they_fell(fell=False)
    assert worst.fell.tolist() == [4, 0, 4]
    assert best.fell.tolist() == [2, 0, 0]
    assert worst.without == best.without == 0
    assert worst.records == best.records == 3
    assert best.share == pytest.approx(2 / 12)
    assert worst.share == pytest.approx(8 / 12)
    known = count_of([2, 0, 1], 4)
    for fell in (False, True):
        assert known.if_they_fell(fell=fell).fell.tolist() == known.fell.tolist()


def test_a_state_is_counted_where_it_is_reached_and_has_an_answer() -> None:
    reached = np.array([[[True], [True]], [[False], [True]]])
    answered = np.array([[[True], [False]], [[True], [True]]])
    (count,) = counts_of(reached, answered)
    assert count.fell.tolist() == [1, 1]
    assert count.answered.tolist() == [1, 2]
    assert count.share == 0.75
