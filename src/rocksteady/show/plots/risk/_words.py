"""Names as pictures show them."""

from rocksteady.show.style import wording
from rocksteady.show.style.escaping import literal


def greek(text: str) -> str:
    """Return a name as a picture shows it, with letters for angles and minus signs.

    Examples
    --------
    >>> greek("theta/alpha > 0.5"), greek("width -5 %")
    ('θ/α > 0.5', 'width −5 %')
    """
    return wording.minus(wording.greek(literal(text)))
