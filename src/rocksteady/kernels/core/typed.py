"""Whole numbers and truth values that one kernel passes to another.

numba takes each literal for a type of its own: a function that is called with ``0``, with ``1`` and
with a variable is compiled three times, and all that it calls with it: so was the march six times.
A constant with a NumPy type counts as a variable does.
"""

import numpy as np


def whole(number: int) -> int:
    """Return a constant that numba types like a variable."""
    return np.int64(number)  # type: ignore[return-value]


ZERO = whole(0)
ONE = whole(1)
MINUS_ONE = whole(-1)
FALSE: bool = np.bool_(False)  # type: ignore[assignment]
TRUE: bool = np.bool_(True)  # type: ignore[assignment]
