"""Samples given with times: checked for even spacing, or resampled to it on request."""

import math
import re
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Final

from rocksteady.kernels.elementary.arrays import log
from rocksteady.records.core.assembling import Given
from rocksteady.records.core.header_statements import last_place
from rocksteady.records.core.numbers import number
from rocksteady.records.core.text import RecordText

if TYPE_CHECKING:
    from rocksteady.arrays import Floats

_JITTER: Final = 0.01
"""Part of the interval by which a time may be off its place."""

_FEW: Final = 0.02
"""Part of the intervals that may differ from the usual one where times are merely written coarsely:
fewer are gaps, unless the usual interval explains them too."""

_MANY: Final = 0.25
_SHORTEST_COARSE: Final = 50
"""Samples that are needed to distinguish coarsely written times from uneven ones."""

_PLAIN: Final = 5
"""Significant digits of the interval, or of its rate, that are usual."""

_UNCERTAIN: Final = 1.0e-6
"""Part of the interval that the digits of its times may leave open without a warning."""

_MOST_SAMPLES: Final = 20_000_000


@dataclass(frozen=True, kw_only=True)
class Spaced:
    """Samples at equal intervals.

    Parameters
    ----------
    values
        Shape (samples,) or (samples, channels).
    dt_s
        Interval [s].
    notes, warnings
        What has been done to them, and what is uncertain of the interval, a sentence each.
    """

    values: "Floats"
    dt_s: float | None
    notes: tuple[str, ...] = ()
    warnings: tuple[str, ...] = ()


def evenly_spaced(
    text: RecordText,
    times: "Floats",
    values: "Floats",
    given: Given,
    *,
    rounding: "float | Floats",
    line_of: Callable[[int], int],
) -> "Spaced":
    """Return samples at equal intervals, with what has been done to them and what is uncertain.

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
        Half a unit of the last digit that each time is written with, or may be [s].
    line_of
        Index of the line of a sample.

    Raises
    ------
    RecordFileError
        If the times do not grow, or not evenly and the caller does not allow resampling.
    """
    import numpy as np

    if len(times) < 2:
        raise text.error("it holds one sample, which is no record", "see whether it is whole")
    mean = float(times[-1] - times[0]) / (len(times) - 1)
    steps = np.diff(times)
    usual = float(np.median(steps))
    spacing = _interval(times, steps, rounding) if mean > 0.0 else None
    if spacing is not None:
        interval, doubts = spacing
        wanted = interval if given.dt_s is None or not given.resample else given.dt_s
        if math.isclose(wanted, interval, rel_tol=1.0e-9):
            return Spaced(values=values, dt_s=interval, warnings=doubts)
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
    step = _rounded(usual, 1.0e-9 * usual) if given.dt_s is None else given.dt_s
    count = int((times[-1] - times[0]) / step * (1.0 + 1.0e-12)) + 1
    if not 2 <= count <= _MOST_SAMPLES:
        raise text.error(f"{count} samples {step:g} s apart would be needed", "give another dt_s")
    even = times[0] + step * np.arange(count)
    table = values.reshape(len(times), -1)
    new = np.stack([interpolated(even, times, column) for column in table.T], axis=1)
    low, high = f"{steps.min():g}", f"{steps.max():g}"
    old = f"{low} s" if low == high else f"intervals of {low} to {high} s"
    note = f"resampled from {old} to {step:g} s (straight lines between the samples)"
    return Spaced(values=new.reshape(count, *values.shape[1:]), dt_s=step, notes=(note,))


def _interval(
    times: "Floats", steps: "Floats", rounding: "float | Floats"
) -> tuple[float, tuple[str, ...]] | None:
    """Return the interval of evenly spaced times, with a warning where digits leave it open.

    None where the digits that the times are written with do not explain how uneven they are.
    """
    import numpy as np

    count = len(times)
    mean = float(times[-1] - times[0]) / (count - 1)
    noise = 1.0e-12 * float(np.abs(times).max())
    off = np.abs(times - (times[0] + mean * np.arange(count)))
    place = np.broadcast_to(np.asarray(rounding, dtype=np.float64), times.shape)
    if bool((off <= 1.0e-6 * mean + noise).all()):
        return _rounded(mean, float(place[0] + place[-1]) / (count - 1)), ()
    # Rounded, or cut off.
    near = 1.01 * place + noise
    low_high = _slopes(times, near) or _slopes(times + place, near)
    if low_high is not None:
        low, high = low_high
        chosen = _simplest(low, high)
        usual = _simplest_near(float(np.median(steps)), float(np.median(place)))
        unlike = np.count_nonzero(np.abs(steps - np.median(steps)) > _JITTER * mean + noise)
        # From the first time as it stands: a gap of one unit of the last digit would else be a
        # first time half a unit off.
        from_usual = np.abs(times - times[0] - usual * np.arange(count))
        explained = low <= usual <= high and bool((from_usual <= near).all() and steps.min() > 0.0)
        explained = explained or bool((off <= _JITTER * mean + noise).all())
        few = _FEW if count >= _SHORTEST_COARSE else _MANY
        coarse = unlike > max(few * len(steps), 2)
        if explained or coarse:
            chosen = usual if low <= usual <= high and not coarse else chosen
            if _rows_missing(times, usual, chosen, near):
                return None
            return chosen, _doubts(low, high, chosen)
    if bool((off <= _JITTER * mean + noise).all()):
        return _rounded(mean, float(place[0] + place[-1]) / (count - 1)), ()
    return None


def _rows_missing(times: "Floats", usual: float, chosen: float, near: "Floats") -> bool:
    """Return whether a usual interval with rows left out explains times better than `chosen`.

    The rate that few digits leave is then none that instruments have: 90.909 Hz where each eleventh
    row of 100 Hz is missing.
    """
    import numpy as np

    if not 0.0 < usual < 0.999 * chosen or _plain_rate(chosen):
        return False
    steps = np.rint((times - times[0]) / usual)
    whole = bool((np.abs(times - times[0] - usual * steps) <= near).all())
    return whole and bool((np.diff(steps) >= 1.0).all()) and _plain_rate(usual)


def _plain_rate(interval: float) -> bool:
    """Return whether a rate is one of instruments: whole, of factors 2 and 5, and 3 once."""
    rate = 1.0 / interval
    whole = round(rate)
    if not math.isclose(rate, whole, rel_tol=1.0e-9) or whole < 1:
        return False
    for factor in (2, 5):
        while whole % factor == 0:
            whole //= factor
    return whole in {1, 3}


def _doubts(low: float, high: float, chosen: float) -> tuple[str, ...]:
    """Return a warning where digits leave the interval open, or it is no usual number."""
    plain = any(
        math.isclose(float(f"{value:.{_PLAIN}g}"), value, rel_tol=1e-12)
        for value in (chosen, 1.0 / chosen)
    )
    if high - low <= _UNCERTAIN * chosen and plain:
        return ()
    odd = "" if plain else ", which is no usual one: see whether rows are missing"
    doubt = (
        f"the digits of its times leave the interval between {low:.9g} and {high:.9g} s: "
        f"{chosen:.9g} s is taken{odd}; give dt_s where it is known"
    )
    return (doubt,)


def _slopes(times: "Floats", place: "Floats") -> tuple[float, float] | None:
    """Return the smallest and largest interval whose multiples are all written as the times are.

    With a first time that is free, an interval fits if the largest lower bound of that time is not
    above the smallest upper bound: their difference is convex in the interval.
    """
    import numpy as np

    at = np.arange(len(times), dtype=np.float64)
    low, high = times - place, times + place

    def gap(slope: float) -> tuple[float, float]:
        below, above = low - slope * at, high - slope * at
        first, second = int(below.argmax()), int(above.argmin())
        return float(below[first] - above[second]), float(second - first)

    mean = float(times[-1] - times[0]) / (len(times) - 1)
    reach = 2.0 * float(place.max()) * 2.0 / (len(times) - 1) + 1.0e-9 * mean
    left, right = mean - reach, mean + reach
    inside = None
    for _ in range(80):
        middle = 0.5 * (left + right)
        size, rising = gap(middle)
        if size <= 0.0:
            inside = middle
            break
        left, right = (left, middle) if rising > 0.0 else (middle, right)
    if inside is None:
        return None
    edges = []
    for outside in (mean - reach, mean + reach):
        good, bad = inside, outside
        for _ in range(60):
            middle = 0.5 * (good + bad)
            good, bad = (middle, bad) if gap(middle)[0] <= 0.0 else (good, middle)
        edges.append(good)
    return edges[0], edges[1]


def _simplest(low: float, high: float) -> float:
    """Return the interval with the fewest digits, its own or those of its rate, within bounds."""
    middle = 0.5 * (low + high)
    for digits in range(1, 16):
        for candidate in (float(f"{middle:.{digits}g}"), 1.0 / float(f"{1.0 / middle:.{digits}g}")):
            if low <= candidate <= high:
                return candidate
    return middle


def _simplest_near(step: float, place: float) -> float:
    """Return the simplest interval that a step between two times is written as."""
    near = min(place, 0.01 * step)
    return _simplest(step - near, step + near) if step > 0.0 else 0.0


def _rounded(interval: float, error: float) -> float:
    """Return an interval, or a rate's, with as few digits as its error leaves meaning to."""
    error = max(error, 1.0e-12 * interval)
    return _simplest(interval - error, interval + error)


def interpolated(at: "Floats", times: "Floats", values: "Floats") -> "Floats":
    """Return values between given ones along straight lines; beyond the last time the last one.

    Parameters
    ----------
    at
        Where they are wanted, at the first time or later.
    times, values
        The given ones, two or more, the times ascending.
    """
    import numpy as np

    start = np.minimum(np.searchsorted(times, at, side="right") - 1, len(times) - 2)
    slope = (np.diff(values) / np.diff(times))[start]
    between: Floats = values[start] + slope * (at - times[start])
    return np.where(at < times[-1], between, values[-1])


def places(written: Sequence[str], sizes: "Floats | None" = None) -> "Floats":
    """Return half a unit of the last digit that each number of a column may be written with.

    A program writes all of them to the same decimals, or to the same significant digits, and may
    leave out zeros at their ends (``%g``): none is finer than the finest of either.

    Parameters
    ----------
    written
        The numbers as they stand in the file; with `sizes`, those with the most digits.
    sizes
        Absolute values of all numbers; by default those of `written`.
    """
    import numpy as np

    mantissas = [re.split("[eEdD]", text)[0].strip("+- ") for text in written]
    digits = max(len(text.replace(".", "").lstrip("0")) for text in mantissas)
    finest = min(map(last_place, written))
    if sizes is None:
        sizes = np.abs([number(text) or 0.0 for text in written])
    tens = np.floor(log(np.where(sizes > 0.0, sizes, finest)) / log(10.0) + 1.0e-12)
    powers, of = np.unique(tens - digits + 1.0, return_inverse=True)
    units = np.array([float(f"1e{power:.0f}") for power in powers.tolist()])
    result: Floats = 0.5 * np.maximum(units[of], finest)
    return result
