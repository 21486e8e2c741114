"""How computations end: the one list of statuses, kinds of attractors and events.

This module is in the lowest layer: it imports nothing from the package, and nothing heavy.
"""

from enum import IntEnum, StrEnum


class Status(IntEnum):
    """Outcome of a computation: an integer for kernels, a label for files, a sentence for people.

    The codes are part of every stored result: a code never changes its meaning, and a new status
    takes the next free integer.
    """

    ROCKING = 0
    AT_REST = 1
    OVERTURNED = 2
    LOST_CONTACT = 3
    UNDECIDED = 4

    @property
    def label(self) -> str:
        """The word that stands in JSON output and in tables (``at-rest``)."""
        return self.name.lower().replace("_", "-")

    @property
    def advice(self) -> str:
        """One sentence: what the status means and what to try next."""
        return _ADVICE[self]


_ADVICE = {
    Status.ROCKING: (
        "The block was still rocking when the run ended; where the shaking goes on, a longer run "
        "shows whether it settles, comes to rest or falls."
    ),
    Status.AT_REST: (
        "The block stands still on its base at the end; it lifts only where the base acceleration "
        "exceeds the uplift limit."
    ),
    Status.OVERTURNED: (
        "The block falls: it is proved that it cannot come back to its base; a larger or stockier "
        "block, weaker or faster shaking, or a smaller tilt at the start keeps it standing."
    ),
    Status.LOST_CONTACT: (
        "The base dropped away at g or faster, so the block left it and the rocking model ends "
        "there; scale the vertical motion down or leave it out."
    ),
    Status.UNDECIDED: (
        "The limit on the number of steps was reached before the outcome was certain; raise the "
        "limit or ask for a shorter time."
    ),
}


class AttractorKind(StrEnum):
    """Kind of attractor, or undecided."""

    SYMMETRIC = "symmetric"
    UNSYMMETRIC = "unsymmetric"
    REST = "rest"
    OVERTURNED = "overturned"
    APERIODIC = "aperiodic"
    UNDECIDED = "undecided"


class Event(IntEnum):
    """Event that ends a passage of the return map, with the codes of its kernel."""

    IMPACT = 0
    """An impact follows; the map has a derivative there."""
    UPLIFT = 1
    """Chatter comes to rest and the block lifts again, at a phase that forgets what was before."""
    GRAZE = 2
    """The block touches its base with next to no speed; the map has no derivative there."""
    OVERTURNED = 3
    """No impact follows."""
    AT_REST = 4
    """Chatter comes to rest, and the shaking never lifts the block again."""
    UNDECIDED = 5
    """The search for the next impact did not end."""

    @property
    def label(self) -> str:
        """The word for tables; the three ends have those of `Status` (``at-rest``)."""
        return self.name.lower().replace("_", "-")


NO_START = -1
"""Code of a cell whose start does not exist, in every map; no outcome has it."""
NO_START_LABEL = "no-start"
INFINITELY_MANY = -1
"""Number of impacts in integer arrays where it is infinite."""
