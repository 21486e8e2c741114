"""A remedy: the least change of one kind with which an object meets its target."""

from dataclasses import dataclass
from typing import Any, Final

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

    def to_dict(self) -> dict[str, Any]:
        """Return plain values."""
        return {**vars(self), "islands": [list(each) for each in self.islands]}
