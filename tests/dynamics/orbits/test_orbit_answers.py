"""Answers of attractors and of searches: what is said of each kind, and rows that keep numbers."""

import math
from typing import Any

import pytest

from rocksteady import (
    Block,
    DimensionlessBlock,
    Harmonic,
    Linear,
    Rest,
    State,
    find_attractor,
    find_orbits,
)
from rocksteady.dynamics.orbits.orbit_facts import worth
from rocksteady.dynamics.orbits.search import describe_orbits
from tests.every import every

BARE = DimensionlessBlock(restitution=0.8)
SIZED = Block.rectangle(width=0.4, height=1.2, restitution=0.8)
UNSYMMETRIC = Harmonic(amplitude=2.0, frequency_ratio=1.9)
SYMMETRIC = Harmonic(amplitude=3.0, frequency_ratio=4.2)
WEAK = Harmonic(amplitude=0.05, frequency_ratio=2.0)
STRONG = Harmonic(amplitude=9.5, frequency_ratio=1.0)
LIFTED = State(angle=0.5, velocity=0.0)


@every(
    ("motion", "start", "sentence", "known"),
    [
        (SYMMETRIC, Rest(), "It settles to a symmetric steady motion, up to ", True),
        (UNSYMMETRIC, Rest(), "It settles to an unsymmetric steady motion, from ", True),
        (WEAK, Rest(), "It rests throughout: the motion never lifts it.", False),
        (WEAK, LIFTED, "It comes to rest, and the motion does not lift it again.", True),
        (STRONG, Rest(), "It falls: from this start (rest) it reaches no steady motion.", False),
    ],
)
def test_each_kind_has_its_sentence_and_when_it_was_known(
    motion: Harmonic, start: State | Rest, sentence: str, known: bool
) -> None:
    found = find_attractor(BARE, motion, start=start)
    description = found.describe()
    answer = description.answer
    assert answer is not None
    assert answer.sentence.startswith(sentence)
    facts = dict(answer.facts)
    periods = f"{found.after} period{'s' if found.after > 1 else ''}, from "
    assert str(facts["known after"]).startswith(periods if known else "")
    assert bool(facts["known after"]) == bool(found.after) == known
    assert bool(facts["stable"]) == (found.orbit is not None)
    assert facts["mirror image"] == ("is an attractor too" if motion == UNSYMMETRIC else "")
    labels = {fact.label for fact in description.facts}
    assert ("known after" in labels) == (motion != STRONG), "of a fall at once nothing is known"


@pytest.mark.parametrize("block", [BARE, SIZED], ids=["bare", "sized"])
def test_rows_of_an_answer_are_the_best_motions_by_their_numbers_in_the_table(
    block: Block | DimensionlessBlock,
) -> None:
    limits: dict[str, Any] = {"max_period": 2, "max_impacts": 4, "seeds": 12}
    orbits = find_orbits(block, UNSYMMETRIC, model="linear", **limits)
    answer = describe_orbits(orbits, block, UNSYMMETRIC, Linear(), **limits).answer
    assert answer is not None
    motions = [orbit for orbit in orbits if orbit.admissible]
    stable = [orbit for orbit in orbits if orbit.stable]
    assert stable
    assert len(motions) < len(orbits)
    verb = "is" if len(stable) == 1 else "are"
    count = f"{len(stable)} of {len(motions)} steady motions {verb} stable"
    assert answer.sentence == f"{count}; found up to 2 periods and 4 impacts."
    head, *rows = (f"{label} {words}".split() for label, words in answer.facts[:3])
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
    words = str(dict(answer.facts)["not listed"])
    assert words == f"{left} more with --more: {left} inadmissible"
