"""Names as pictures show them."""

from typing import Final

from rocksteady.show.style import wording
from rocksteady.show.style.escaping import literal

FALLING: Final = "share of runs that fall"
"""Label of an axis of counted shares."""


def greek(text: str) -> str:
    """Return a name as a picture shows it, with letters for angles and minus signs.

    Examples
    --------
    >>> greek("theta/alpha > 0.5"), greek("width -5 %")
    ('θ/α > 0.5', 'width −5 %')
    """
    return wording.minus(wording.greek(literal(text)))
