"""Intensity measures of records, and their dimensionless forms for a given block."""

import math
from dataclasses import dataclass

import numpy as np

from rocksteady.arrays import Floats
from rocksteady.kernels.elementary.arrays import tan
from rocksteady.model.blocks.block import Block
from rocksteady.model.blocks.gravity import STANDARD_GRAVITY
from rocksteady.model.checks.arguments import checked, checked_result
from rocksteady.model.checks.validation import positive
from rocksteady.model.motions.record import Record
from rocksteady.results.numbers import number
from rocksteady.results.result import Result
from rocksteady.seismic.measures._durations import absolute_velocity, strong_shaking
from rocksteady.seismic.measures.response_spectrum import DAMPING, compute_response_spectrum
from rocksteady.seismic.measures.time_course import integrate_record

HOUSNER_PERIODS_S = np.linspace(0.1, 2.5, 49)
"""Where the pseudo-velocity is evaluated for Housner's intensity: every 0.05 s."""

MEAN_PERIOD_HZ = (0.25, 20.0)
"""Frequencies that count for the mean period."""
FINEST_HZ = 0.05
"""Their largest distance; shorter records are padded with zeros."""


@checked_result
@dataclass(frozen=True, kw_only=True, repr=False)
class Measures(Result):
    """Intensity measures of a record, from `rocksteady.compute_measures`.

    All are exact for an acceleration that is linear between samples, from rest, except
    `arias_of_samples_m_s`, `mean_period_s`, which is made of the samples' Fourier amplitudes, and
    `housner_intensity_m`, an integral by Simpson's rule of exact ordinates.

    Attributes
    ----------
    record, block
        Record, and block of the last three measures; None without.
    pga_m_s2, pga_g, pgv_m_s, pgd_m
        Largest absolute acceleration [m/s^2], in units of 9.80665 m/s^2, velocity [m/s] and
        displacement [m] of the ground.
    pgv_per_pga_s
        PGV over PGA [s].
    arias_m_s
        pi/(2 g) times the integral of a^2 [m/s].
    arias_of_samples_m_s
        The same by the trapezoidal rule on the squares of the samples [m/s], as in most programs
        and tables of records: larger, the more so the fewer samples a swing has.
    cav_m_s
        The integral of abs(a) [m/s].
    significant_5_75_s, significant_5_95_s
        Times from 5 % to 75 % and to 95 % of the Arias intensity [s].
    rms_m_s2
        Root of the mean of a^2 over the second of the two [m/s^2]; what comes before and after the
        strong shaking does not dilute it.
    bracketed_s, uniform_s
        From first to last time above the threshold, and time above it in all [s].
    threshold_m_s2
        The threshold [m/s^2].
    mean_period_s
        Mean period of Rathje and others, sum(C^2/f)/sum(C^2) over 0.25 to 20 Hz [s]; nan where the
        record has no frequency there.
    housner_intensity_m
        Integral of the pseudo-velocity over periods from 0.1 to 2.5 s [m].
    damping
        Damping of those oscillators.
    final_velocity_m_s, drifts
        Velocity of the ground at the record's end [m/s], and whether PGD is that of an error in the
        baseline: because that velocity is more than a twentieth of PGV, or PGD more than 5 s times
        PGV.
    pga_per_uplift, p_pgv_per_uplift, p_pgv_per_pga
        PGA/(g tan alpha), p PGV/(g tan alpha) and p PGV/PGA of a block, of the side that lifts
        first; None without.
    """

    record: Record
    block: Block | None = None
    pga_m_s2: float
    pga_g: float
    pgv_m_s: float
    pgd_m: float
    pgv_per_pga_s: float
    arias_m_s: float
    arias_of_samples_m_s: float
    cav_m_s: float
    significant_5_75_s: float
    significant_5_95_s: float
    rms_m_s2: float
    bracketed_s: float
    uniform_s: float
    threshold_m_s2: float
    mean_period_s: float
    housner_intensity_m: float
    damping: float
    final_velocity_m_s: float
    drifts: bool
    pga_per_uplift: float | None = None
    p_pgv_per_uplift: float | None = None
    p_pgv_per_pga: float | None = None

    @property
    def peaks_text(self) -> str:
        """PGA, PGV and PGD in words."""
        return f"{number(self.pga_g)} g, {number(self.pgv_m_s)} m/s and {number(self.pgd_m)} m"

    @property
    def peak_per_uplift(self) -> float | None:
        """Largest acceleration towards a side over what lifts the block to that side.

        None without a block; below 1 a block at rest stays so.  A block against a wall has one
        side.
        """
        if self.block is None:
            return None
        samples, block = self.record.acceleration_m_s2, self.block
        peaks = [(float(samples.max()), block.positive), (-float(samples.min()), block.negative)]
        sides = peaks[:1] if block.one_sided else peaks
        return max(0.0, *(peak / (block.gravity * tan(side.alpha)) for peak, side in sides))

    @property
    def warning(self) -> str | None:
        """A sentence on a record that drifts; None of one that does not."""
        if not self.drifts:
            return None
        return (
            f"PGD = {self.pgd_m:.3g} m is that of an error of the baseline, not of a ground: it is "
            f"{self.pgd_m / self.pgv_m_s:.2g} s times PGV, and the record ends with "
            f"{abs(self.final_velocity_m_s) / self.pgv_m_s:.0%} of PGV; --baseline linear "
            "(records.Cleaning) may help"
        )


@checked
def compute_measures(
    record: Record,
    block: Block | None = None,
    *,
    damping: float = DAMPING,
    threshold_m_s2: float = 0.05 * STANDARD_GRAVITY,
) -> Measures:
    """Measure the intensity of a record: PGA, Arias intensity, durations and more.

    Parameters
    ----------
    record
        The record, whose ground begins at rest.
    block
        Block whose slenderness and p the dimensionless measures need; default none.
    damping
        Damping of the oscillators of Housner's intensity, in [0, 1), 1 being critical; default
        0.05.
    threshold_m_s2
        Threshold of the bracketed and the uniform duration [m/s^2]; default 0.05 g.

    Returns
    -------
    Measures
        Equations and sources are in ``docs/guides/measures.md``.

    Raises
    ------
    InputError
        If `block` is no block, a number is outside its range, or the record is beyond 1e50 m/s^2 or
        sampled at more than 10 s.

    Examples
    --------
    A period of a sine of 2 m/s^2 and 1 Hz, whose velocity grows to 2/pi and falls to 0 again:

    >>> import numpy as np
    >>> from rocksteady import Block, Record, compute_measures
    >>> samples = 2.0 * np.sin(2.0 * np.pi * np.arange(1001) / 1000)
    >>> result = compute_measures(Record(acceleration_m_s2=samples, dt_s=0.001))
    >>> print(f"{result.pgv_m_s:.4f} {result.pgd_m:.4f} {result.cav_m_s:.4f}")
    0.6366 0.3183 1.2732
    """
    hint = "give an acceleration in m/s^2"
    threshold = positive("threshold_m_s2", threshold_m_s2, hint=hint)
    course = integrate_record(record)
    pga, pgv = abs(course.peak_acceleration.value), abs(course.peak_velocity.value)
    begin, most, end = (course.time_of_arias(part) for part in (0.05, 0.75, 0.95))
    arias = float(course.arias_m_s[-1])
    squares = float(np.trapezoid(np.square(record.acceleration_m_s2), dx=record.dt_s))
    strong = strong_shaking(record, threshold)
    spectrum = compute_response_spectrum(record, HOUSNER_PERIODS_S, damping=damping)
    return Measures(
        record=record,
        block=block,
        pga_m_s2=pga,
        pga_g=pga / STANDARD_GRAVITY,
        pgv_m_s=pgv,
        pgd_m=abs(course.peak_displacement.value),
        pgv_per_pga_s=pgv / pga,
        arias_m_s=arias,
        arias_of_samples_m_s=0.5 * math.pi / STANDARD_GRAVITY * squares,
        cav_m_s=absolute_velocity(record),
        significant_5_75_s=most - begin,
        significant_5_95_s=end - begin,
        rms_m_s2=math.sqrt(0.9 * 2.0 * STANDARD_GRAVITY / math.pi * arias / (end - begin)),
        bracketed_s=strong.bracketed_s,
        uniform_s=strong.uniform_s,
        threshold_m_s2=threshold,
        mean_period_s=mean_period(record),
        housner_intensity_m=_simpson(spectrum.pseudo_velocity_m_s, HOUSNER_PERIODS_S),
        damping=spectrum.damping,
        final_velocity_m_s=float(course.velocity_m_s[-1]),
        drifts=course.drifts,
        **({} if block is None else _felt(block, pga, pgv)),
    )


def mean_period(record: Record) -> float:
    """Return Rathje's mean period [s], of Fourier amplitudes from 0.25 to 20 Hz.

    Frequencies are at most 0.05 Hz apart; shorter records are padded with zeros.  It is nan where
    the record has nothing there.

    References
    ----------
    E. M. Rathje, F. Faraj, S. Russell and J. D. Bray, Earthquake Spectra 20, 119-144 (2004).
    """
    from scipy.fft import next_fast_len

    samples = record.acceleration_m_s2
    needed = math.ceil(1.0 / (FINEST_HZ * record.dt_s))
    count = next_fast_len(max(needed, len(samples)), real=True)
    frequency = np.fft.rfftfreq(count, record.dt_s)
    inside = (frequency >= MEAN_PERIOD_HZ[0]) & (frequency <= MEAN_PERIOD_HZ[1])
    swing = np.fft.rfft(samples, count)[inside]
    power = np.square(swing.real) + np.square(swing.imag)
    total = float(power.sum())
    return float((power / frequency[inside]).sum()) / total if total > 0.0 else math.nan


def _felt(block: Block, pga: float, pgv: float) -> dict[str, float]:
    """Return the dimensionless measures of the side that lifts first."""
    side = min((block.positive, block.negative), key=lambda body_side: body_side.alpha)
    uplift = block.gravity * tan(side.alpha)
    return {
        "pga_per_uplift": pga / uplift,
        "p_pgv_per_uplift": side.p * pgv / uplift,
        "p_pgv_per_pga": side.p * pgv / pga,
    }


def _simpson(values: Floats, at: Floats) -> float:
    """Return an integral over evenly spaced points, an odd number of them."""
    weights = np.where(np.arange(len(at)) % 2 == 1, 4.0, 2.0)
    weights[[0, -1]] = 1.0
    return float((weights * values).sum()) * float(at[-1] - at[0]) / (3.0 * (len(at) - 1))
