"""Names of motions on the page, and shares: those of the package."""

from rocksteady.outcomes import NEVER_LIFTS, AttractorKind, motion_verb, motion_words
from rocksteady.results.numbers import chance
from tests.explorer.in_node import InNode

LINES = """
const { NEVER_LIFTS, motionName, motionWords } = await import(parts('words.mjs'));
const motions = asked.map(([kind, period]) => ({ kind, period }));
answer([NEVER_LIFTS, ...motions.map(motionName), ...motions.map(motionWords)]);
"""

SHARES = """
const { shareWords } = await import(parts('words.mjs'));
answer(Array.from({ length: asked + 1 }, (_, falls) => shareWords(falls, asked)));
"""


def test_every_motion_has_the_name_of_the_package(in_node: InNode) -> None:
    motions = [(kind, period) for kind in AttractorKind for period in (None, *range(1, 21))]
    found = in_node(LINES, [(kind.label, period) for kind, period in motions])
    names = [words(*motion) for words in (motion_words, motion_verb) for motion in motions]
    assert found == [NEVER_LIFTS, *names]
    assert "rocks, alike every seventh shake" not in found
    assert "rocks, alike every third shake" in found


def test_shares_are_written_as_in_the_terminal(in_node: InNode) -> None:
    cells = 144 * 108
    none, *some, every = (words.split(" of the ")[0] for words in in_node(SHARES, cells))
    assert (none, every) == ("none", "all")
    assert some == [chance(falls / cells) for falls in range(1, cells)]
