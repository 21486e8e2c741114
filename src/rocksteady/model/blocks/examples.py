"""Named blocks: of the literature, and of common equipment, each with its source."""

import math
from collections.abc import Callable
from functools import partial

from rocksteady.errors import InputError
from rocksteady.kernels.elementary.arrays import atan2, hypot

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


def _cylinder() -> dict[str, float]:
    """Return a thin tube, whose radius of gyration is ``sqrt(d^2/8 + h^2/12)``."""
    diameter, height = 0.229, 1.64
    radius = 0.5 * hypot(diameter, height)
    inertia = radius * radius + diameter * diameter / 8.0 + height * height / 12.0
    return {"mass": 1.0, "inertia": inertia, "radius": radius, "alpha": atan2(diameter, height)}


def _statue() -> dict[str, float]:
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
    gyration = math.sqrt(inertia / mass)
    return {
        "left": left,
        "right": 0.6 - left,
        "height": 0.9 + 1.7,
        "mass_centre_height": centre,
        "gyration": gyration,
    }


CONSTRUCTORS: dict[str, tuple[str, Callable[[], dict[str, float]]]] = {
    "tso-wong-1989": ("from_p", partial(dict, alpha=0.2, p=2.0 * math.pi, restitution=0.8)),
    "makris-roussos-2000": ("rectangle", partial(dict, width=1.0, height=3.0, restitution=0.85)),
    "zhang-makris-2001": ("from_p", partial(dict, alpha=0.25, p=2.14, restitution=0.9)),
    "fema-p58-cabinet": ("rectangle", partial(dict, width=18.6 * INCH, height=67.75 * INCH)),
    "server-rack": ("rectangle", partial(dict, width=0.6, height=2.0)),
    "gas-cylinder": ("general", _cylinder),
    "statue-on-plinth": ("asymmetric", _statue),
}
"""The constructor of `Block` that makes each named block, and what returns its arguments."""

PARTS = {"statue-on-plinth": "statue and plinth"}
"""Parts of the named blocks that consist of several and are computed as one body."""


def constructor_of(name: object) -> tuple[str, dict[str, float]]:
    """Return the constructor of a named block and its arguments.

    Raises
    ------
    InputError
        If there is no block of that name.
    """
    if not isinstance(name, str) or name not in CONSTRUCTORS:
        known = ", ".join(CONSTRUCTORS)
        raise InputError("name", name, "there is no block of that name", f"choose one of {known}")
    constructor, arguments = CONSTRUCTORS[name]
    return constructor, arguments()
