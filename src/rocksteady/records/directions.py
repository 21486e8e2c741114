"""Which way a channel points, from the name that a file gives to it."""

import re
from typing import Final

from rocksteady.records.recording import Orientation

__all__ = ["direction"]

_VERTICAL: Final = frozenset(
    {"up", "u", "ud", "u-d", "updo", "updown", "dwn", "down", "dn", "d"}
    | {"v", "vert", "vertical", "vrt", "ver", "z", "-up", "v1"}
)
_OF_A_STRUCTURE: Final = frozenset(
    {"h", "h1", "h2", "l", "l1", "t", "t1", "long", "tran", "fn", "fp", "radial", "transverse"}
)
"""Horizontal directions of a structure, a fault or a path, whose azimuth is not in their name."""

_COMPASS: Final = {
    **dict.fromkeys(("n", "ns", "n-s", "north", "north-south", "s-n", "sn"), 0.0),
    **dict.fromkeys(("e", "ew", "e-w", "east", "east-west", "w-e", "we"), 90.0),
    **dict.fromkeys(("s", "south"), 180.0),
    **dict.fromkeys(("w", "west"), 270.0),
}
_QUADRANT: Final = re.compile(r"([ns])\s*(\d+(?:\.\d*)?)\s*(?:deg\w*)?\s*([ew])")
# 1, 2 and 3 alone number channels.
_DEGREES: Final = re.compile(r"(?:[nh]\s*(?=\d{3}))?(?![123]$)(\d{1,3}(?:\.\d*)?)\s*(?:deg\w*)?")
# Band, instrument, direction: the three letters of a SEED channel whose instrument is one that
# measures acceleration.
_SEED: Final = re.compile(r"[a-z][gnl]([enz123xyrt])")


def direction(component: str | None) -> tuple[Orientation | None, float | None]:
    """Return whether a channel is horizontal or vertical, and its azimuth [degrees].

    Parameters
    ----------
    component
        As the file names it.

    Examples
    --------
    >>> [direction(name) for name in ("S69E", "N-S", "HNZ", "090", "DWN")]  # doctest: +ELLIPSIS
    [('horizontal', 111.0), ('horizontal', 0.0), ('vertical', None), ('horizontal', 90.0), ...]
    >>> direction("HN1"), direction("sensor 7")
    (('horizontal', None), (None, None))
    """
    text = "" if component is None else component.strip().strip("()[]").lower()
    if text in _VERTICAL:
        return "vertical", None
    azimuth = _azimuth(text)
    if azimuth is not None:
        return "horizontal", azimuth
    if text in _OF_A_STRUCTURE:
        return "horizontal", None
    seed = _SEED.fullmatch(text)
    if seed is None:
        return None, None
    # A channel named 3 is the vertical one of some networks and not of others.
    pointing: dict[str, Orientation | None] = {"z": "vertical", "3": None}
    return pointing.get(seed[1], "horizontal"), {"n": 0.0, "e": 90.0}.get(seed[1])


def _azimuth(text: str) -> float | None:
    """Return the azimuth [degrees] that the name of a direction states."""
    if text in _COMPASS:
        return _COMPASS[text]
    if quadrant := _QUADRANT.fullmatch(text):
        degrees = float(quadrant[2]) if quadrant[3] == "e" else -float(quadrant[2])
        return (degrees if quadrant[1] == "n" else 180.0 - degrees) % 360.0
    number = _DEGREES.fullmatch(text)
    if number is None or float(number[1]) > 360.0:
        return None
    return float(number[1]) % 360.0
