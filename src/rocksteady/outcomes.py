"""How computations end: the one list of statuses, kinds of attractors and events.

An outcome equals its word and its code: ``run.status == "overturned"`` and ``run.status == 2``.
It equals nothing else: a word that is no label of it is unequal, as for any text, and outcomes of
different lists compare by their words.  Arrays hold codes: ``batch.status == Status.OVERTURNED``,
``kinds == AttractorKind.REST.code``.  In sets and as keys a `Status` or an `Event` is its code and
an `AttractorKind` its word, since Python cannot hash both alike.

This module lies low: it imports only the errors, and nothing heavy.
"""

from enum import Enum, IntEnum, StrEnum
from numbers import Integral
from typing import Self

from rocksteady.errors import InputError

__all__ = ["AttractorKind", "Event"]
"""The public names, beside `Status` on top of the package."""


class _Outcome(Enum):
    """An outcome with a word and a code, which equals both."""

    @property
    def label(self) -> str:
        """The word that stands in JSON output and in tables (``at-rest``)."""
        return self.name.lower().replace("_", "-")

    @property
    def code(self) -> int:
        """The whole number that stands in arrays."""
        return self.value if isinstance(self.value, int) else list(type(self)).index(self)

    def __eq__(self, other: object) -> bool:
        """Return whether another is the same outcome, its word or its code."""
        if isinstance(other, str | _Outcome):
            return self.label == getattr(other, "label", other)
        return self.code == int(other) if isinstance(other, Integral) else NotImplemented

    def __ne__(self, other: object) -> bool:
        """Return whether another is neither the same outcome nor its word or code."""
        same = self.__eq__(other)
        return same if same is NotImplemented else not same

    def __hash__(self) -> int:
        """Return the hash of the value: a code, or a word."""
        return hash(self.value)

    @classmethod
    def _missing_(cls, value: object) -> Self:
        """Return the outcome of a word or a code."""
        for each in cls:
            if each == value:
                return each
        words = ", ".join(each.label for each in cls)
        raise InputError(cls.__name__, value, f"it must be one of {words}", "give one of them")


class Status(_Outcome, IntEnum):
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
    def plain(self) -> str:
        """The verb of sentences and legends: it rocks, comes to rest, falls."""
        return _PLAIN[self]

    @property
    def advice(self) -> str:
        """One sentence: what the status means and what to try next."""
        return _ADVICE[self]


_PLAIN = {
    Status.ROCKING: "rocks",
    Status.AT_REST: "comes to rest",
    Status.OVERTURNED: "falls",
    Status.LOST_CONTACT: "leaves its base",
    Status.UNDECIDED: "undecided",
}
_ADVICE = {
    Status.ROCKING: (
        "The block was still rocking when the run ended; where the shaking goes on, a longer run "
        "may show whether it settles, comes to rest or falls."
    ),
    Status.AT_REST: (
        "The block stands still on its base at the end; it lifts only where the base acceleration "
        "exceeds the uplift limit."
    ),
    Status.OVERTURNED: (
        "The block falls: it is proved that it cannot come back to its base; run every change of "
        "block, motion or start again, as a weaker motion may fell what now stands."
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
BALANCED = "stands balanced: any disturbance decides"
"""Of a block that rocks no more, and neither falls nor comes back."""


class AttractorKind(_Outcome, StrEnum):
    """Kind of attractor, or undecided; its label is its value."""

    SYMMETRIC = "symmetric"
    UNSYMMETRIC = "unsymmetric"
    REST = "rest"
    OVERTURNED = "overturned"
    APERIODIC = "aperiodic"
    UNDECIDED = "undecided"

    @property
    def plain(self) -> str:
        """The verb of sentences, as of `Status`; of orbits that repeat every shake."""
        return _PLAIN_KINDS[self]


_PLAIN_KINDS = {
    AttractorKind.SYMMETRIC: "rocks",
    AttractorKind.UNSYMMETRIC: "rocks, further to one side",
    AttractorKind.REST: "comes to rest",
    AttractorKind.OVERTURNED: "falls",
    AttractorKind.APERIODIC: "never repeats",
    AttractorKind.UNDECIDED: "undecided",
}
NEVER_LIFTS = "never lifts"
"""Of a block that the motion does not move at all."""
ORDINALS = {
    2: "second",
    3: "third",
    4: "fourth",
    5: "fifth",
    6: "sixth",
    8: "eighth",
    16: "sixteenth",
}


def motion_words(kind: AttractorKind, period: int | None) -> str:
    """Return the verb of an attractor: of an orbit by its period in shakes.

    Examples
    --------
    >>> motion_words(AttractorKind.SYMMETRIC, 3), motion_words(AttractorKind.REST, None)
    ('rocks, alike every third shake', 'comes to rest')
    """
    if period is None or period < 2:
        return kind.plain
    return f"rocks, alike every {ORDINALS.get(period, f'{period}th')} shake"


def motion_verb(kind: AttractorKind, period: int | None) -> str:
    """Return what stands after "it" in a sentence.

    Examples
    --------
    >>> motion_verb(AttractorKind.UNSYMMETRIC, 1), motion_verb(AttractorKind.SYMMETRIC, 3)
    ('rocks with the shaking, further to one side', 'rocks, alike every third shake')
    """
    words = motion_words(kind, period)
    if period == 1:
        words = words.replace("rocks", "rocks with the shaking")
    return _VERBS.get(kind, words)


_VERBS = {
    AttractorKind.APERIODIC: "rocks and never repeats",
    AttractorKind.UNDECIDED: "is not decided",
}


class Event(_Outcome, IntEnum):
    """Event that ends a passage of the return map, with the codes of its kernel.

    The labels of the three ends are those of `Status`.
    """

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


NO_START = -1
"""Code of a cell whose start does not exist, in every map; no outcome has it."""
NO_START_LABEL = "no-start"
INFINITELY_MANY = -1
"""Number of impacts in integer arrays where it is infinite."""
