"""Samples that come with their times: evenly spaced, or brought to even spacing when asked."""

import math
from collections.abc import Callable
from typing import TYPE_CHECKING, Final

from rocksteady.records.building import Given
from rocksteady.records.text import RecordText

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    Floats = NDArray[np.float64]

__all__ = ["evenly_spaced"]

_JITTER: Final = 0.01
"""Part of the interval by which a time may be off its place."""

_FEW: Final = 0.02
"""Part of the intervals that may differ from the usual one where times are merely written coarsely:
fewer are gaps."""

_SHORTEST_COARSE: Final = 50
"""Samples that it takes to tell coarsely written times from uneven ones."""

_MOST_SAMPLES: Final = 20_000_000


def evenly_spaced(
    text: RecordText,
    times: "Floats",
    values: "Floats",
    given: Given,
    *,
    rounding: float,
    line_of: Callable[[int], int],
) -> tuple["Floats", float, tuple[str, ...]]:
    """Return samples at equal intervals, the interval [s], and a note where they were interpolated.

    Parameters
    ----------
    text
        The file.
    times
        Time of each sample [s], shape (samples,).
    values
        The samples, shape (samples,) or (samples, channels).
    given
        What the caller says: with `resample`, the samples are interpolated to `dt_s`, or unevenly
        spaced ones to the median interval.
    rounding
        Half a unit of the last digit that the times are written with [s].
    line_of
        Index of the line of a sample.

    Raises
    ------
    RecordFileError
        If the times do not grow, or not evenly and the caller has not asked for resampling.
    """
    import numpy as np

    if len(times) < 2:
        raise text.error("it holds one sample, which is no record", "see whether it is whole")
    mean = float(times[-1] - times[0]) / (len(times) - 1)
    steps = np.diff(times)
    usual = float(np.median(steps))
    if mean > 0.0 and _even(times, steps, rounding):
        interval = _rounded(mean, rounding / (len(times) - 1))
        wanted = interval if given.dt_s is None or not given.resample else given.dt_s
        if math.isclose(wanted, interval, rel_tol=1.0e-9):
            return values, interval, ()
        times = times[0] + interval * np.arange(len(times))
        steps = np.diff(times)
    if not bool((steps > 0.0).all()):
        back = int(np.flatnonzero(~(steps > 0.0))[0]) + 1
        raise text.error(
            f"its time, {times[back]:g} s, does not come after {times[back - 1]:g} s",
            "give a file whose times grow",
            at=line_of(back),
        )
    if not given.resample:
        odd = int(np.argmax(np.abs(steps - usual))) + 1
        raise text.error(
            f"its time, {times[odd]:g} s, is {steps[odd - 1]:g} s after the one before, and most "
            f"are {usual:g} s apart",
            "ask for resampling (resample) to have it interpolated",
            at=line_of(odd),
        )
    step = usual if given.dt_s is None else given.dt_s
    count = int((times[-1] - times[0]) / step * (1.0 + 1.0e-12)) + 1
    if not 2 <= count <= _MOST_SAMPLES:
        raise text.error(f"{count} samples {step:g} s apart would be needed", "give another dt_s")
    even = times[0] + step * np.arange(count)
    table = values.reshape(len(times), -1)
    new = np.stack([np.interp(even, times, column) for column in table.T], axis=1)
    low, high = f"{steps.min():g}", f"{steps.max():g}"
    old = f"{low} s" if low == high else f"intervals of {low} to {high} s"
    note = f"resampled from {old} to {step:g} s (straight lines between the samples)"
    return new.reshape(count, *values.shape[1:]), step, (note,)


def _even(times: "Floats", steps: "Floats", rounding: float) -> bool:
    """Return whether times are evenly spaced, but for the digits that they are written with."""
    import numpy as np

    mean = float(times[-1] - times[0]) / (len(times) - 1)
    off = np.abs(times - (times[0] + mean * np.arange(len(times))))
    noise = 1.0e-12 * float(np.abs(times).max())
    if bool((off <= _JITTER * mean + noise).all()):
        return True
    unlike = np.abs(steps - np.median(steps)) > _JITTER * mean + noise
    coarse = len(times) >= _SHORTEST_COARSE and np.count_nonzero(unlike) > _FEW * len(steps)
    return bool(coarse and (off <= 1.01 * rounding + noise).all())


def _rounded(interval: float, error: float) -> float:
    """Return an interval with as few digits as its error leaves meaning to."""
    for digits in range(1, 15):
        candidate = float(f"{interval:.{digits}g}")
        if abs(candidate - interval) <= max(error, 1.0e-12 * interval):
            return candidate
    return interval
