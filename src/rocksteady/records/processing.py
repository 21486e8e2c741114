"""Processing on request: baseline correction and resampling."""

import math
from dataclasses import replace
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

ResamplingMethod = Literal["linear", "filtered"]
"""Straight lines between the samples, or a low-pass filter below half the new rate."""


@checked
def correct_baseline(recording: Recording, baseline: str) -> Recording:
    """Return a recording with its least-squares baseline removed.

    Parameters
    ----------
    recording
        The recording.
    baseline
        ``none`` (nothing is done), ``mean``, ``linear`` or ``polynomial:N`` with the order N.

    Returns
    -------
    Recording
        Its `processing` names what has been taken off.

    Raises
    ------
    InputError
        If it is none of these.

    Examples
    --------
    >>> import tempfile
    >>> from pathlib import Path
    >>> from rocksteady.records import read_recordings
    >>> path = Path(tempfile.mkdtemp()) / "shock.csv"
    >>> rows = ["time (s),acceleration (g)", "0,0", "0.01,0.2", "0.02,-0.1", "0.03,0"]
    >>> _ = path.write_text(chr(10).join(rows))
    >>> (recording,) = read_recordings(path)
    >>> correct_baseline(recording, "mean").record.acceleration_m_s2.round(4)
    array([-0.2452,  1.7162, -1.2258, -0.2452])
    """
    order = _order(baseline)
    if order is None:
        return recording
    import numpy as np

    record = recording.record
    values = record.acceleration_m_s2
    fitted = _fitted(values, min(order, len(values) - 1))
    corrected = replace(record, acceleration_m_s2=values - fitted)
    largest = float(np.abs(fitted).max())
    what = {0: "the mean", 1: "a straight line"}.get(order, f"a polynomial of order {order}")
    note = f"baseline: {what}, fitted by least squares, taken off ({largest:.3g} m/s^2 at most)"
    return recording.processed(corrected, note)


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


def _order(baseline: str) -> int | None:
    """Return the order of the polynomial to take off, or None for none."""
    word, _, order = str(baseline).partition(":")
    plain = {"none": None, "mean": 0, "linear": 1}
    if word in plain and not order:
        return plain[word]
    known = word == "polynomial" and len(order) < 10 and order.isdecimal()
    if known and 0 <= int(order) <= _HIGHEST_ORDER:
        return int(order)
    raise InputError(
        "baseline",
        baseline,
        "it must be a way of taking off a baseline",
        f"use none, mean, linear or polynomial:N with N up to {_HIGHEST_ORDER}",
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
