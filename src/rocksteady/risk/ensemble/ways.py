"""In which ways an ensemble runs each record: signs, and vertical components."""

from dataclasses import dataclass
from typing import Literal

from rocksteady.model.checks.arguments import checked


@checked
@dataclass(frozen=True, kw_only=True)
class Ways:
    """Signs of the records, and whether their vertical components act.

    Parameters
    ----------
    reverse
        "both" (default) for the records as they are and reversed, True or False for one of the two.
    vertical
        "both" (default) for runs with and without the vertical components, where there are any;
        True or False for one of the two.  A record without one has the same run twice, so that all
        records weigh the same; ``copied`` marks the second.  Components act with the sign of their
        files, upwards positive, reversed horizontal records too.

    Raises
    ------
    InputError
        If one is none of the three.

    Examples
    --------
    >>> from rocksteady.risk import Ways
    >>> Ways(reverse=False)
    Ways(reverse=False, vertical='both')
    """

    reverse: bool | Literal["both"] = "both"
    vertical: bool | Literal["both"] = "both"
