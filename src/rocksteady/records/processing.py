"""Processing on request: offset, filter, trim and resampling."""

import math
import re
from contextlib import suppress
from dataclasses import dataclass, replace
from datetime import timedelta
from typing import TYPE_CHECKING, Final, Literal

from rocksteady.errors import InputError
from rocksteady.model.checks.arguments import checked
from rocksteady.model.checks.validation import positive
from rocksteady.records.core.recording import Recording
from rocksteady.records.core.sampling import interpolated

if TYPE_CHECKING:
    from rocksteady.arrays import Floats

_HIGHEST_ORDER: Final = 10
_MOST_SAMPLES: Final = 20_000_000
_LOWEST: Final = 1e-6
"""End of a filter in sampling rates below which rounding errors take over."""

ResamplingMethod = Literal["linear", "filtered"]
"""Straight lines between the samples, or a low-pass filter below half the new rate."""


@checked
@dataclass(frozen=True, kw_only=True)
class Cleaning:
    """Offset, filter and trim of recordings, in this order.

    Parameters
    ----------
    baseline
        Baseline to subtract: ``none``, ``mean``, ``pre:SECONDS`` (the mean of the first seconds,
        before the event), ``linear`` or ``polynomial:N`` with the order N.
    filter_hz
        Frequencies to keep [Hz]: ``LOW:HIGH``, ``LOW:`` or ``:HIGH``. A Butterworth filter of
        order 2 runs forwards and backwards: no phase shift, order 4, half the amplitude at an end.
    trim_s
        Times to keep, both ends included [s after the first sample]: ``START:END``, ``START:`` or
        ``:END``.

    Raises
    ------
    InputError
        If a text is none of these.

    Examples
    --------
    >>> import tempfile
    >>> from pathlib import Path
    >>> from rocksteady.records import read_recordings
    >>> path = Path(tempfile.mkdtemp()) / "shock.csv"
    >>> rows = ["time (s),acceleration (g)", "0,0", "0.01,0.2", "0.02,-0.1", "0.03,0"]
    >>> _ = path.write_text(chr(10).join(rows))
    >>> (recording,) = read_recordings(path)
    >>> cleaned = Cleaning(baseline="mean", trim_s="0.01:").apply(recording)
    >>> cleaned.record.acceleration_m_s2.round(4)
    array([ 1.7162, -1.2258, -0.2452])
    """

    baseline: str = "none"
    filter_hz: str | None = None
    trim_s: str | None = None

    def __post_init__(self) -> None:
        """Validate."""
        _level(self.baseline)
        _ends("filter_hz", self.filter_hz)
        _ends("trim_s", self.trim_s)

    @property
    def remark(self) -> str:
        """A sentence on what is done to each record, empty where nothing is."""
        steps = {
            "baseline": self.baseline.removeprefix("none"),
            "filter": _span(self.filter_hz, "Hz"),
            "trim": _span(self.trim_s, "s"),
        }
        done = ", ".join(f"{step} {words}" for step, words in steps.items() if words)
        return f"Each record was cleaned: {done}." if done else ""

    def apply(self, recording: Recording) -> Recording:
        """Return a cleaned recording.

        Parameters
        ----------
        recording
            The recording.

        Returns
        -------
        Recording
            Its `processing` has a note on each step.

        Raises
        ------
        InputError
            If an end lies outside the record or reaches its Nyquist frequency, or nothing is left.
        """
        steps = ((_levelled, self.baseline), (_banded, self.filter_hz), (_trimmed, self.trim_s))
        for step, given in steps:
            if given not in (None, "none"):
                recording = step(recording, given)
        return recording


@checked
def resample(
    recording: Recording, dt_s: float, *, method: ResamplingMethod = "linear"
) -> Recording:
    """Return a recording with another sampling interval.

    A record is straight between its samples, so a finer interval that divides the old one leaves
    the motion as it is with ``linear``. A coarser one drops what lies between the new samples;
    ``filtered`` first takes off what they cannot show (`scipy.signal.resample_poly`).

    Parameters
    ----------
    recording
        The recording.
    dt_s
        The new interval [s]; the record itself comes back where it is the old one.
    method
        ``linear`` or ``filtered``.

    Returns
    -------
    Recording
        Its `processing` names the method; the record ends with its last whole interval.

    Raises
    ------
    InputError
        If the interval is not positive, leaves fewer than two samples or more than 2e7, or the
        method is not known.

    Examples
    --------
    >>> import tempfile
    >>> from pathlib import Path
    >>> from rocksteady.records import read_recordings
    >>> path = Path(tempfile.mkdtemp()) / "shock.csv"
    >>> rows = ["time (s),acceleration (g)", "0,0", "0.01,0.2", "0.02,-0.1", "0.03,0"]
    >>> _ = path.write_text(chr(10).join(rows))
    >>> (recording,) = read_recordings(path)
    >>> resample(recording, 0.005).record
    Record(name='shock', samples=7, dt_s=0.005, peak_acceleration_m_s2=1.96133)
    """
    step = positive("dt_s", dt_s, hint="give the new time between samples in seconds")
    if method not in ("linear", "filtered"):
        raise InputError(
            "method", method, "it must be a way of resampling", "use linear or filtered"
        )
    record = recording.record
    if math.isclose(step, record.dt_s, rel_tol=1.0e-9):
        return recording
    import numpy as np

    # A duration of a whole number of steps stays one, in spite of rounding.
    steps = record.duration_s / step * (1.0 + 1.0e-12) + 1.0e-9
    count = math.floor(steps) + 1 if steps < _MOST_SAMPLES else _MOST_SAMPLES + 1
    if not 2 <= count <= _MOST_SAMPLES:
        raise InputError(
            "dt_s",
            dt_s,
            f"{record.duration_s:g} s would have {max(1.0, steps):.10g} samples",
            f"give an interval near the record's, {record.dt_s:g} s",
        )
    values = record.acceleration_m_s2
    if method == "linear":
        old = record.dt_s * np.arange(len(values), dtype=np.float64)
        new = interpolated(step * np.arange(count, dtype=np.float64), old, values)
    else:
        new = _filtered(values, record.dt_s, step)[:count]
    note = f"resampled from {record.dt_s:g} s to {step:g} s ({method})"
    return recording.processed(replace(record, acceleration_m_s2=new, dt_s=step), note)


def _fitted(values: "Floats", order: int) -> "Floats":
    """Return the polynomial of an order that fits evenly spaced values best, at each of them.

    By Forsythe's polynomials [1]_, orthogonal over the very points: no equations are solved.

    References
    ----------
    .. [1] G. E. Forsythe, J. Soc. Ind. Appl. Math. 5, 74-88 (1957).
    """
    import numpy as np

    time = np.linspace(-1.0, 1.0, len(values))
    fitted = np.zeros(len(values))
    before, here = np.zeros(len(values)), np.ones(len(values))
    square, last = float(len(values)), 1.0
    for _ in range(order + 1):
        fitted += float(((values - fitted) * here).sum()) / square * here
        before, here = here, time * here - square / last * before
        square, last = float(np.square(here).sum()), square
    return fitted


def _levelled(recording: Recording, baseline: str) -> Recording:
    """Return a recording with its baseline subtracted."""
    import numpy as np

    order, seconds = _level(baseline)
    values = recording.record.acceleration_m_s2
    if seconds:
        count = 1 + _sample(recording, "baseline", baseline, seconds)
        fitted = np.full(len(values), values[:count].mean())
        what = f"the mean of the first {seconds:g} s"
    else:
        fitted = _fitted(values, min(order, len(values) - 1))
        what = {0: "the mean", 1: "a straight line"}.get(order, f"a polynomial of order {order}")
        what += ", fitted by least squares"
    note = f"baseline: {what}, taken off ({np.abs(fitted).max():.3g} m/s^2 at most)"
    return recording.processed(replace(recording.record, acceleration_m_s2=values - fitted), note)


def _banded(recording: Recording, filter_hz: str) -> Recording:
    """Return a recording with the frequencies of a band."""
    from scipy.signal import butter, sosfiltfilt

    low, high = _ends("filter_hz", filter_hz)
    values, rate = recording.record.acceleration_m_s2, 1.0 / recording.record.dt_s
    for end in (low, high):
        if end in (0.0, math.inf):
            continue
        if not _LOWEST * rate <= end < 0.5 * rate:
            valid = f"its ends must lie in [{_LOWEST * rate:g}, {0.5 * rate:.6g}) Hz, below the "
            valid += f"Nyquist frequency of {recording.path.name}"
            raise InputError("filter_hz", filter_hz, valid, "change them, or leave one empty")
        kind: Literal["highpass", "lowpass"] = "highpass" if end == low else "lowpass"
        sections = butter(2, end, kind, fs=rate, output="sos")
        # The base keeps its first and its last acceleration while the filter settles.
        pad = round(min(len(values) - 1, 2.0 * rate / end))
        values = sosfiltfilt(sections, values, padtype="constant", padlen=pad)
    note = f"filter: {_span(filter_hz, 'Hz')}, Butterworth of order 4 without phase shift"
    return recording.processed(replace(recording.record, acceleration_m_s2=values), note)


def _trimmed(recording: Recording, trim_s: str) -> Recording:
    """Return the part of a recording between two times, at the nearest samples."""
    start, end = _ends("trim_s", trim_s)
    record, begin = recording.record, recording.start_time
    end = record.duration_s if end == math.inf else end
    first, last = (_sample(recording, "trim_s", trim_s, time) for time in (start, end))
    kept = record.acceleration_m_s2[first : last + 1]
    if len(kept) < 2 or not kept.any():
        valid = f"it leaves no two samples of {recording.path.name} that shake"
        raise InputError("trim_s", trim_s, valid, "keep more of it")
    if begin is not None:
        recording = replace(recording, start_time=begin + timedelta(seconds=first * record.dt_s))
    note = f"trim: {start:g} to {end:g} s kept"
    return recording.processed(replace(record, acceleration_m_s2=kept), note)


def _sample(recording: Recording, name: str, given: str, time_s: float) -> int:
    """Return the sample nearest to a time of a record."""
    record = recording.record
    if time_s > record.duration_s + 0.5 * record.dt_s:
        valid = f"{recording.path.name} has {record.duration_s:g} s"
        raise InputError(name, given, valid, "give times inside it, in seconds")
    return round(time_s / record.dt_s)


def _ends(name: str, given: str | None) -> tuple[float, float]:
    """Return the ends of a span; an open one is 0 or infinite."""
    with suppress(AttributeError, TypeError, ValueError):
        first, second = ("0:inf" if given is None else given).split(":")
        low, high = float(first or 0.0), float(second or math.inf)
        if 0.0 <= low < high and given != ":":
            return low, high
    valid = "it must be two numbers, 0 or above, the first one below the second"
    raise InputError(name, given, valid, "write 0.1:25; one of them may be empty")


def _span(given: str | None, unit: str) -> str:
    """Return a span in words; nothing of none."""
    low, _, high = (given or "").partition(":")
    if low and high:
        return f"{low} to {high} {unit}"
    return (f"from {low} {unit}" if low else f"up to {high} {unit}") * bool(given)


def _level(baseline: str) -> tuple[int, float]:
    """Return the order of a baseline, and the seconds of which it is the mean: 0 of all."""
    word, _, number = str(baseline).partition(":")
    plain = {"none": 0, "mean": 0, "linear": 1}
    if word in plain and not number:
        return plain[word], 0.0
    digits = len(number) < 10 and number.isdecimal()
    if word == "polynomial" and digits and int(number) <= _HIGHEST_ORDER:
        return int(number), 0.0
    if word == "pre" and re.fullmatch(r"\d*\.?\d+", number) and float(number) > 0.0:
        return 0, float(number)
    raise InputError(
        "baseline",
        baseline,
        "it must be a baseline to subtract",
        f"use none, mean, pre:SECONDS, linear or polynomial:N with N up to {_HIGHEST_ORDER}",
    )


def _filtered(values: "Floats", old: float, new: float) -> "Floats":
    """Return the samples at another rate, low-pass filtered below half of it.

    Raises
    ------
    InputError
        If the ratio of the two intervals is not one of small whole numbers.
    """
    from fractions import Fraction

    from scipy.signal import resample_poly

    ratio = Fraction(old / new).limit_denominator(1000)
    if ratio.numerator > 1000 or abs(float(ratio) * new / old - 1.0) > 1.0e-9:
        raise InputError(
            "dt_s",
            new,
            f"its ratio to {old:g} s must be one of whole numbers up to 1000",
            "give such an interval, or method linear",
        )
    result: Floats = resample_poly(values, ratio.numerator, ratio.denominator, padtype="line")
    return result
