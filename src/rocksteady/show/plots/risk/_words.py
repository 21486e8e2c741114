"""Names as pictures show them."""

import re

from rocksteady.show.style.escaping import literal


def greek(text: str) -> str:
    """Return a name as a picture shows it, with letters for angles.

    Examples
    --------
    >>> greek("theta/alpha > 0.5")
    'θ/α > 0.5'
    """
    shown = literal(text)
    for word, letter in (("theta", "θ"), ("alpha", "α"), ("pi", "π")):
        shown = re.sub(rf"\b{word}\b", letter, shown)
    return shown
