"""Piecewise-linear form of base motions that segments cannot represent exactly.

No other module samples a base motion.  A flight on a line is exact, so that the bound of `polyline`
is the whole error.  Parabolas would be fewer, but a fourth kind of forcing in the kernels.
"""

import math
from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING

from rocksteady.errors import InputError
from rocksteady.model.motions.segments import Segment

if TYPE_CHECKING:
    from rocksteady.arrays import Floats

MOST_LINES = 200_000
"""Straight lines of one motion; as many take some seconds to make."""


def straight_lines(values: "Floats", step: float) -> tuple[Segment, ...]:
    """Return the segments of a motion that is straight between evenly spaced samples.

    Parameters
    ----------
    values
        Base acceleration in units of alpha g, shape (samples,), at least two.
    step
        Pivot time p t between two of them.
    """
    slopes = (values[1:] - values[:-1]) / step
    return tuple(
        Segment(duration=step, constant=float(value), slope=float(slope))
        for value, slope in zip(values[:-1], slopes, strict=True)
    )


def polyline(
    acceleration: "Callable[[Floats], Floats]",
    parts: Sequence[tuple[float, float]],
    *,
    tolerance: float,
    size: float = 1.0,
) -> tuple[Segment, ...]:
    """Return straight lines that are nowhere further than a tolerance from a smooth motion.

    A chord over a time h misses a function by at most ``max|a''| h^2 / 8``.  The lines of a part
    are of one length, the longest that keeps this bound below the tolerance.

    Parameters
    ----------
    acceleration
        Base acceleration in units of alpha g, at an array of pivot times, 0 or above.
    parts
        Parts of the motion, in order: the pivot time that each lasts, and an upper bound of the
        size of its second derivative there.
    tolerance
        In units of alpha g.
    size
        By what the lines are multiplied, and their error with them.

    Raises
    ------
    InputError
        If more than 200 000 lines would be needed.

    Examples
    --------
    >>> import numpy as np
    >>> lines = polyline(lambda s: np.sin(s), [(2.0, 1.0)], tolerance=1e-4)
    >>> len(lines), round(1.0 * lines[0].duration ** 2 / 8.0, 6)
    (71, 9.9e-05)
    """
    import numpy as np

    needed = [time * math.sqrt(curvature / (8.0 * tolerance)) for time, curvature in parts]
    refuse_many_lines(sum(needed), tolerance)
    lines: tuple[Segment, ...] = ()
    start = 0.0
    for (time, _), least in zip(parts, needed, strict=True):
        count = max(1, math.ceil(least))
        values = size * acceleration(np.linspace(start, start + time, count + 1))
        lines += straight_lines(values, time / count)
        start += time
    return lines


def refuse_many_lines(needed: float, tolerance: float) -> None:
    """Refuse a tolerance that needs too many straight lines.

    Raises
    ------
    InputError
        If they are more than 200 000.
    """
    if needed > MOST_LINES:
        excess = needed / MOST_LINES
        raise InputError(
            "tolerance",
            tolerance,
            f"{needed:.3g} straight lines would be needed, and {MOST_LINES} are the most",
            f"give {tolerance * excess * excess:.2g} or more, or a shorter motion",
        )
