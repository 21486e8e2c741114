"""Words of orbits: kinds, rows of files, the period, and the best motions of a search."""

import math
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from rocksteady import Block, DimensionlessBlock, Harmonic, Linear, find_orbits
from rocksteady.words.orbits import describe_orbits, kind_text, orbit_facts, orbits_table, worth
from tests.every import every
from tests.outputs import lines_of

BARE = DimensionlessBlock(restitution=0.8)
SIZED = Block.rectangle(width=0.4, height=1.2, restitution=0.8)
MOTION = Harmonic(amplitude=2.0, frequency_ratio=1.9)
STRONG = Harmonic(amplitude=2.0, frequency_ratio=4.0)


@every(
    ("period", "text"),
    [(None, "rocking"), (1, "rocking"), (2, "rocking, period 2"), (3, "rocking, period 3")],
)
def test_a_period_is_named_above_one(period: int | None, text: str) -> None:
    assert kind_text("rocking", period) == text


@every("block", [BARE, SIZED])
def test_a_row_of_an_orbit_has_its_first_state_extremes_and_multipliers(
    block: Block | DimensionlessBlock,
) -> None:
    orbits = find_orbits(block, MOTION, max_period=2, max_impacts=4, seeds=12, model="linear")
    assert {orbit.admissible for orbit in orbits} == {True, False}
    table = orbits_table(orbits)
    for place, (orbit, row) in enumerate(zip(orbits, table.rows, strict=True), start=1):
        assert (row["number"], row["period"]) == (place, orbit.period)
        assert (row["impacts_per_period"], row["branch"]) == (orbit.impacts, orbit.branch)
        first, second = np.asarray(orbit.multipliers)
        assert (row["multiplier_1_re"], row["multiplier_1_im"]) == (first.real, first.imag)
        assert (row["multiplier_2_re"], row["multiplier_2_im"]) == (second.real, second.imag)
        state = orbit.states[0]
        assert (row["side"], row["phase_rad"]) == (state.side, state.phase)
        assert row["speed_per_pivot_time"] == state.speed
        ends = (orbit.highest, orbit.lowest) if orbit.admissible else (None, None)
        assert (row["highest"], row["lowest"]) == ends
        assert row["stable"] is (orbit.stable if orbit.admissible else None)
        shown = [
            column.words(row) for column in table.columns if column.key in ("highest", "lowest")
        ]
        if isinstance(block, Block):
            radians = [None if end is None else end * block.alpha for end in ends]
            assert [row["highest_rad"], row["lowest_rad"]] == radians
            expected = ["—" if u is None else f"{math.degrees(u):.2f}°" for u in radians]
        else:
            assert "highest_rad" not in row
            expected = ["—" if u is None else f"{u:.4f}" for u in ends]
        assert shown == expected
        words = {fact.label: fact.words for fact in orbit_facts(orbit)}
        many = orbit.period > 1
        period = f"{orbit.period} forcing periods, subharmonic" if many else "1 forcing period"
        if isinstance(block, Block):
            seconds = orbit.period * 2.0 * math.pi / (1.9 * block.p)
            assert words["period"] == f"{period}, {seconds:.3g} s"
        else:
            assert words["period"] == period
        assert words["impacts"] == f"{orbit.impacts} in a period"
        assert ("highest" in words) is ("lowest" in words) is orbit.admissible


def test_a_symmetric_orbit_is_named_by_the_branch_of_its_closed_form() -> None:
    orbits = find_orbits(BARE, STRONG, max_period=1, seeds=6)
    table = orbits_table(orbits)
    by_label = {column.heading: column for column in table.columns}
    kinds = [by_label["kind"].words(row) for row in table.rows]
    assert kinds == ["symmetric 1", "symmetric 2"]
    assert [by_label[""].words(row) for row in table.rows] == ["stable", "inadmissible"]
    facts = orbit_facts(orbits[0])
    assert next(fact.words for fact in facts if fact.label == "branch") == "1"
    labels = [fact.label for fact in facts if fact.label]
    assert labels == ["period", "impacts", "highest", "lowest", "multipliers of a period", "branch"]


def test_an_orbit_that_rests_has_infinitely_many_impacts_and_its_rests_are_counted() -> None:
    orbit = find_orbits(BARE, Harmonic(amplitude=2.0, frequency_ratio=4.0), max_period=1, seeds=6)[
        0
    ]
    for rests, words in ((1, "1 time in a period"), (2, "2 times in a period")):
        resting = replace(orbit, rest_phases=rests, branch=None)
        said = {fact.label: fact.words for fact in orbit_facts(resting)}
        assert said["impacts"] == "infinitely many in a period"
        assert said["comes to rest"] == words
        assert "branch" not in said
        table = orbits_table([resting])
        impacts, kind = (
            next(column for column in table.columns if column.heading == label)
            for label in ("impacts", "kind")
        )
        assert (impacts.words(table.rows[0]), kind.words(table.rows[0])) == ("inf", "symmetric")
    assert len(orbits_table([]).rows) == 0


@pytest.mark.parametrize("block", [BARE, SIZED], ids=["bare", "sized"])
def test_rows_of_an_answer_are_the_best_motions_by_their_numbers_in_the_table(
    block: Block | DimensionlessBlock,
) -> None:
    limits: dict[str, Any] = {"max_period": 2, "max_impacts": 4, "seeds": 12}
    orbits = find_orbits(block, MOTION, model="linear", **limits)
    answer = describe_orbits(orbits, block, MOTION, Linear(), **limits)
    motions = [orbit for orbit in orbits if orbit.admissible]
    stable = [orbit for orbit in orbits if orbit.stable]
    assert stable
    assert len(motions) < len(orbits)
    verb = "is" if len(stable) == 1 else "are"
    count = f"{len(stable)} of {len(motions)} steady motions {verb} stable"
    assert answer.sentence == f"{count}; found up to 2 periods and 4 impacts."
    head, *rows = (f"{label} {words}".split() for label, words in answer.screen[:3])
    assert head[-5:] == ["period", "impacts", "highest", "lowest", "multipliers"]
    listed = [orbits[int(row[0]) - 1] for row in rows]
    assert [row[1] for row in rows] == [worth(orbit) for orbit in listed] == ["stable", "unstable"]
    for orbit, row in zip(listed, rows, strict=True):
        assert row[2:5] == [orbit.kind, str(orbit.period), str(orbit.impacts)]
        for end, tilt in zip((orbit.highest, orbit.lowest), row[5:7], strict=True):
            if isinstance(block, Block):
                assert tilt == f"{math.degrees(end * block.alpha):.2f}°"
            else:
                assert tilt == f"{end:.3f}"
    left = len(orbits) - len(listed)
    words = str(lines_of(answer)["not listed"])
    assert words == f"{left} more with --more: {left} inadmissible"
