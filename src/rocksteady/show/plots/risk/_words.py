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
    return re.sub(r"\btheta\b", "θ", re.sub(r"\balpha\b", "α", literal(text)))
