"""What came of repeating recorded calls."""

from typing import NamedTuple


class Repeated(NamedTuple):
    """A call that was made again."""

    entry: str
    values: int
    """Number of values compared."""
    differing: int
    """How many of them differ."""


class MissingProgramError(Exception):
    """A program that runs a target is not installed."""


def read(text: str) -> list[Repeated]:
    """Return what a replay printed: a line a call, with its kernel and two numbers."""
    found = []
    for line in text.splitlines():
        entry, values, differing = line.split()
        found.append(Repeated(entry, int(values), int(differing)))
    return found
