"""Named blocks: of the literature, and of common equipment, each with its source."""

import math
from collections.abc import Callable

from rocksteady.errors import InputError, with_call_errors
from rocksteady.kernels.elementary.arrays import atan2, hypot
from rocksteady.model.blocks.block import STANDARD_GRAVITY, Block
from rocksteady.model.blocks.housner_forms import Restitution

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
    "server-rack": (
        "A cabinet for 42 units of 44.45 mm of 19-inch equipment (EIA-310-D (1992); "
        "IEC 60297-3-100 (2008)), 0.6 m wide and 2.0 m high, rocking sideways.  The outline is "
        "common on the market and not of the standards; assumed homogeneous: equipment fills it "
        "evenly.  Restitution after Housner."
    ),
    "gas-cylinder": (
        "A seamless steel cylinder of 50 litres, of the kind that ISO 9809-1 (2019) covers, "
        "0.229 m in diameter and 1.64 m high.  The size is common on the market and not of the "
        "standard; assumed a thin tube with its mass centre at half height, rocking in a plane on "
        "a base of its full diameter.  Restitution from angular momentum."
    ),
    "statue-on-plinth": (
        "A statue, 0.5 m wide and 1.7 m high, fixed 0.05 m to the right of the middle of a plinth "
        "0.6 m wide and 0.9 m high.  All sizes are assumed, of no real statue; unattached "
        "asymmetric structures of this kind were tested by C. E. Wittich and T. C. Hutchinson, "
        "Earthquake Eng. Struct. Dyn. 44, 2425-2443 (2015).  Both are homogeneous boxes, and the "
        "statue has half the mass of the plinth.  Restitution of each impact from angular momentum."
    ),
}
"""What each named block is, and where it comes from."""


@with_call_errors
def named_block(
    name: str,
    *,
    restitution: Restitution | None = None,
    gravity: float = STANDARD_GRAVITY,
) -> Block:
    """Return a named block of the literature or of common equipment.

    Parameters
    ----------
    name
        "tso-wong-1989", "makris-roussos-2000", "zhang-makris-2001", "fema-p58-cabinet",
        "server-rack", "gas-cylinder" or "statue-on-plinth".  Sizes, sources and assumptions are in
        `rocksteady.model.blocks.examples.SOURCES`.
    restitution
        Restitution in place of the source's; all forms of the constructors of `Block`.
    gravity
        Acceleration of gravity [m/s^2]; default 9.80665.

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
            "there is no block of that name",
            "choose one of " + ", ".join(SOURCES),
        )
    measured: dict[str, Restitution] = {
        "tso-wong-1989": 0.8,
        "makris-roussos-2000": 0.85,
        "zhang-makris-2001": 0.9,
    }
    ratio = measured.get(name, "housner") if restitution is None else restitution
    return _MAKERS[name](ratio, gravity)


def _rectangle(width: float, height: float) -> "Maker":
    """Return what makes a homogeneous rectangle [m]."""
    return lambda ratio, gravity: Block.rectangle(
        width=width, height=height, restitution=ratio, gravity=gravity
    )


def _from_p(alpha: float, p: float) -> "Maker":
    """Return what makes a block of a slenderness [rad] and a frequency parameter [rad/s]."""
    return lambda ratio, gravity: Block.from_p(alpha=alpha, p=p, restitution=ratio, gravity=gravity)


def _cylinder(ratio: Restitution, gravity: float) -> Block:
    """Return a thin tube, whose radius of gyration is ``sqrt(d^2/8 + h^2/12)``."""
    diameter, height = 0.229, 1.64
    radius = 0.5 * hypot(diameter, height)
    return Block.general(
        mass=1.0,
        inertia=radius * radius + diameter * diameter / 8.0 + height * height / 12.0,
        radius=radius,
        alpha=atan2(diameter, height),
        restitution=ratio,
        gravity=gravity,
    )


def _statue(ratio: Restitution, gravity: float) -> Block:
    """Return two boxes, one on the other: mass centre and inertia by the parallel axes."""
    # Width, height, mass, and the middle above the plinth's lower left corner.
    boxes = ((0.6, 0.9, 2.0, 0.3, 0.45), (0.5, 1.7, 1.0, 0.35, 1.75))
    mass = sum(m for _, _, m, _, _ in boxes)
    left = sum(m * x for _, _, m, x, _ in boxes) / mass
    centre = sum(m * y for _, _, m, _, y in boxes) / mass
    inertia = sum(
        m * ((b * b + h * h) / 12.0 + (x - left) * (x - left) + (y - centre) * (y - centre))
        for b, h, m, x, y in boxes
    )
    return Block.asymmetric(
        left=left,
        right=0.6 - left,
        height=2.0 * centre,
        gyration=math.sqrt(inertia / mass),
        restitution=ratio,
        gravity=gravity,
    )


Maker = Callable[[Restitution, float], Block]

_MAKERS: dict[str, Maker] = {
    "tso-wong-1989": _from_p(0.2, 2.0 * math.pi),
    "makris-roussos-2000": _rectangle(1.0, 3.0),
    "zhang-makris-2001": _from_p(0.25, 2.14),
    "fema-p58-cabinet": _rectangle(18.6 * INCH, 67.75 * INCH),
    "server-rack": _rectangle(0.6, 2.0),
    "gas-cylinder": _cylinder,
    "statue-on-plinth": _statue,
}
