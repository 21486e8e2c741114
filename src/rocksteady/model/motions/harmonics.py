"""Harmonics of periodic shaking, as triples of order, size and phase."""

import math

from rocksteady.errors import InputError
from rocksteady.model.checks.validation import LARGEST, in_range, whole_number

HIGHEST_ORDER = 64
"""Highest order of a harmonic."""
LARGEST_PHASE = 1.0e6
"""Phases beyond it [rad] have lost the digits in which they differ."""

Harmonics = tuple[tuple[int, float, float], ...]
"""Triples (k, a_k, phi_k) of order, size and phase [rad]."""


def harmonics_value(given: object) -> Harmonics:
    """Return harmonics, the lowest order first.

    Raises
    ------
    InputError
        If they are no triples of numbers in their ranges, an order stands twice, or all are 0.
    """
    hint = "give triples (order, size, phase), as ((1, 1.0, 0.0), (2, 0.5, 0.0))"
    rows = list(given) if isinstance(given, tuple | list) else []
    if not rows or not all(isinstance(row, tuple | list) and len(row) == 3 for row in rows):
        raise InputError("harmonics", given, "it must be a sequence of triples", hint)
    harmonics: dict[int, tuple[int, float, float]] = {}
    for order, size, phase in rows:
        k = whole_number("order", order, at_least=1, at_most=HIGHEST_ORDER, hint=hint)
        if k in harmonics:
            raise InputError("harmonics", given, f"order {k} may stand in it once", hint)
        harmonics[k] = (
            k,
            in_range("size", size, -LARGEST, LARGEST, "[]", hint=hint),
            in_range("phase", phase, -LARGEST_PHASE, LARGEST_PHASE, "[]", hint=hint),
        )
    if math.fsum(abs(size) for _, size, _ in harmonics.values()) == 0.0:
        raise InputError(
            "harmonics", given, "one size must not be 0", "give Harmonic(amplitude=0.0, ...)"
        )
    return tuple(harmonics[k] for k in sorted(harmonics))
