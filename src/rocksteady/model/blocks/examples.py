"""Named blocks of the literature, each with its source."""

import math

from rocksteady.errors import InputError
from rocksteady.model.blocks.block import STANDARD_GRAVITY, Block
from rocksteady.model.blocks.sides import Restitution

INCH = 0.0254
"""[m]"""

SOURCES = {
    "tso-wong-1989": (
        "p = 2 pi rad/s, restitution 0.8: the block of Figs 8 to 13.  W. K. Tso and C. M. Wong, "
        "Earthquake Eng. Struct. Dyn. 18, 89-106 (1989).  Its slenderness is not stated; 0.2 rad "
        "is taken here, on which no dimensionless result depends."
    ),
    "makris-roussos-2000": (
        "1 m wide and 3 m high, with the restitution 0.85 of the one-sine example.  N. Makris and "
        "Y. S. Roussos, Geotechnique 50, 243-262 (2000)."
    ),
    "zhang-makris-2001": (
        "An electrical cabinet: p = 2.14 rad/s, alpha = 0.25 rad, restitution 0.9.  J. Zhang and "
        "N. Makris, J. Eng. Mech. 127, 473-483 (2001)."
    ),
    "fema-p58-cabinet": (
        "An unanchored cabinet 18.6 in deep and 67.75 in high, one of the sizes of FEMA P-58's "
        "fragilities of unanchored contents (2012).  Restitution after Housner."
    ),
}
"""What each named block is, and where it comes from."""


def named_block(
    name: str,
    *,
    restitution: Restitution | None = None,
    gravity: float = STANDARD_GRAVITY,
) -> Block:
    """Return a named block of the literature; `SOURCES` lists names and citations.

    Parameters
    ----------
    name
        A key of `SOURCES`.
    restitution
        In place of the source's.
    gravity
        [m/s^2]

    Raises
    ------
    InputError
        If there is no block of that name, or another value is outside its range.

    Examples
    --------
    >>> named_block("zhang-makris-2001").restitution
    0.9
    """
    given: object = name
    if not isinstance(given, str) or given not in SOURCES:
        raise InputError(
            "name",
            name,
            "there is no example block of that name",
            "choose one of " + ", ".join(SOURCES),
        )
    if name == "tso-wong-1989":
        ratio = 0.8 if restitution is None else restitution
        return Block.from_p(alpha=0.2, p=2.0 * math.pi, restitution=ratio, gravity=gravity)
    if name == "makris-roussos-2000":
        ratio = 0.85 if restitution is None else restitution
        return Block.rectangle(width=1.0, height=3.0, restitution=ratio, gravity=gravity)
    if name == "zhang-makris-2001":
        ratio = 0.9 if restitution is None else restitution
        return Block.from_p(alpha=0.25, p=2.14, restitution=ratio, gravity=gravity)
    ratio = "housner" if restitution is None else restitution
    return Block.rectangle(
        width=18.6 * INCH, height=67.75 * INCH, restitution=ratio, gravity=gravity
    )
