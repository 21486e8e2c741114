"""Words of attractors: the sentence of each kind, and when it was known."""

from rocksteady import (
    DimensionlessBlock,
    Harmonic,
    Rest,
    State,
    find_attractor,
)
from tests.every import every
from tests.outputs import lines_of

BARE = DimensionlessBlock(restitution=0.8)
UNSYMMETRIC = Harmonic(amplitude=2.0, frequency_ratio=1.9)
SYMMETRIC = Harmonic(amplitude=3.0, frequency_ratio=4.2)
WEAK = Harmonic(amplitude=0.05, frequency_ratio=2.0)
STRONG = Harmonic(amplitude=9.5, frequency_ratio=1.0)
LIFTED = State(angle=0.5, velocity=0.0)


@every(
    ("motion", "start", "sentence", "known"),
    [
        (SYMMETRIC, Rest(), "It rocks with the shaking, and leans ", True),
        (
            UNSYMMETRIC,
            Rest(),
            "It rocks with the shaking, further to one side, and leans from ",
            True,
        ),
        (WEAK, Rest(), "It never lifts under the motion.", False),
        (WEAK, LIFTED, "It comes to rest, and the motion does not lift it again.", True),
        (STRONG, Rest(), "It falls: from this start (rest) it reaches no steady motion.", False),
    ],
)
def test_each_kind_has_its_sentence_and_when_it_was_known(
    motion: Harmonic, start: State | Rest, sentence: str, known: bool
) -> None:
    found = find_attractor(BARE, motion, start=start)
    description = found.describe()
    assert description.sentence.startswith(sentence)
    facts = lines_of(description)
    periods = f"{found.after} period{'s' if found.after > 1 else ''}, from "
    assert str(facts["known after"]).startswith(periods if known else "")
    assert bool(facts["known after"]) == bool(found.after) == known
    assert bool(facts["stable"]) == (found.orbit is not None)
    assert facts["mirror image"] == ("is an attractor too" if motion == UNSYMMETRIC else "")
    labels = {fact.label for fact in description.facts if not fact.first}
    assert ("known after" in labels) == (motion != STRONG), "of a fall at once nothing is known"
