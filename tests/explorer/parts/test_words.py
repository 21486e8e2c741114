"""Names of motions on the page: those of the package's outcomes."""

from rocksteady.outcomes import NEVER_LIFTS, AttractorKind, motion_words
from tests.explorer.in_node import InNode

LINES = """
const { NEVER_LIFTS, motionName } = await import(parts('words.mjs'));
answer([NEVER_LIFTS, ...asked.map(([kind, period]) => motionName({ kind, period }))]);
"""


def test_every_motion_has_the_name_of_the_package(in_node: InNode) -> None:
    motions = [(kind, period) for kind in AttractorKind for period in (None, *range(1, 21))]
    found = in_node(LINES, [(kind.label, period) for kind, period in motions])
    assert found == [NEVER_LIFTS, *(motion_words(kind, period) for kind, period in motions)]
    assert "rocks, alike every seventh shake" not in found
    assert "rocks, alike every third shake" in found
