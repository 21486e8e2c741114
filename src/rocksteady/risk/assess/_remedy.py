"""A remedy: the least change of one kind with which an object meets its target."""

from dataclasses import dataclass
from typing import Any, Final

from rocksteady.results.numbers import chance, length
from rocksteady.risk.counted.verdict import MARGIN, Target

CHANGES: Final = ("base width", "mass centre lower")
"""Kinds of change, the usual one first."""


@dataclass(frozen=True, kw_only=True)
class Remedy:
    """The least change of one kind with which an object meets its target.

    Attributes
    ----------
    change, unit
        What is changed, and the unit of the values.
    value
        Least value from which no larger one lets more than the target fall, at the demand and at
        1.1 times it; None where none does, or the object as it is does.
    share, share_1_1
        Share that falls at that value, at the demand and at 1.1 times it.
    shown_at
        Least value from which each is green, or stands, with an upper end of the interval below
        the target at 1.1 times the demand too; None where none is.
    islands
        First and last of smaller values that pass, where larger ones do not.
    last
        The largest value that was run.
    slides
        Whether the next one would slide.
    friction_needed
        Friction that it needs at the larger of both values; None without one.
    """

    change: str
    unit: str
    value: float | None
    share: float | None
    share_1_1: float | None
    shown_at: float | None
    islands: tuple[tuple[float, float], ...]
    last: float
    slides: bool
    friction_needed: float | None

    @property
    def values(self) -> list[float]:
        """The least value that meets the target and the one that is shown to; those there are."""
        return [value for value in (self.value, self.shown_at) if value is not None]

    @property
    def warning(self) -> str:
        """What to know of smaller values that pass; empty where there are none."""
        if not self.islands:
            return ""
        spans = ", ".join(" to ".join(dict.fromkeys(map(length, ends))) for ends in self.islands)
        more = "" if self.value is None else f" below {length(self.value)}"
        return (
            f"{self.change.capitalize()}: {spans} would do too, but not all others{more}; shares "
            "need not fall with a change."
        )

    def to_dict(self) -> dict[str, Any]:
        """Return plain values."""
        return {**vars(self), "islands": [list(each) for each in self.islands]}


def change_words(remedy: Remedy, target: Target) -> str:
    """Return the least change of a kind, as "base 165 mm wide (9.0 % at 1.1 x); ..."."""

    def named(value: float) -> str:
        if remedy.change == CHANGES[0]:
            return f"base {length(value)} wide"
        return f"mass centre {length(value)} lower"

    if remedy.value is None and remedy.shown_at is None:
        reason = "the next would slide" if remedy.slides else "the last that was run"
        return f"none up to a {named(remedy.last)}, {reason}"
    if remedy.value is None:
        return f"{named(remedy.shown_at or 0.0)} to be sure of {target.words}"
    beyond = f"{chance(remedy.share_1_1)} at" if remedy.share_1_1 else "none falls at"
    words = f"{named(remedy.value)} ({beyond} {MARGIN:g} x)"
    if remedy.shown_at is not None and remedy.shown_at > remedy.value:
        words += f"; {length(remedy.shown_at)} to be sure of {target.words}"
    return words
