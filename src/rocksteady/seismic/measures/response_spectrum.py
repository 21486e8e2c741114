"""Elastic response spectra of records, exact for acceleration linear between samples."""

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, Annotated

import numpy as np
from numpy.typing import ArrayLike

from rocksteady.arrays import Floats
from rocksteady.dynamics.arrays import real_array
from rocksteady.errors import InputError
from rocksteady.kernels.elementary.arrays import exp, log
from rocksteady.kernels.linear.oscillator import fill_largest
from rocksteady.model.checks.arguments import checked, checked_result
from rocksteady.model.checks.bounds import Bounds, Whole
from rocksteady.model.checks.validation import LARGEST, in_range
from rocksteady.model.motions.oscillator import DEFAULT_DAMPING, rate_of, states
from rocksteady.model.motions.record import Record
from rocksteady.results.result import Result, words_module
from rocksteady.seismic.measures.time_course import refuse_extreme

if TYPE_CHECKING:
    import xarray


LONGEST_S = 1.0e9
"""Longest period [s]; the squares of its inverse are still numbers."""

SHORTEST = 0.01
"""Shortest period over the interval of a record: each sample is then 200 steps."""

DAMPING = DEFAULT_DAMPING

ORDINATES = {
    "periods_s": "s",
    "displacement_m": "m",
    "velocity_m_s": "m s-1",
    "acceleration_m_s2": "m s-2",
    "pseudo_velocity_m_s": "m s-1",
    "pseudo_acceleration_m_s2": "m s-2",
}
"""Arrays of a spectrum, with their units."""


@checked_result
@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class ResponseSpectrum(Result):
    """Peak responses of damped oscillators to a record, as arrays of shape (periods,).

    Attributes
    ----------
    record
        Record that shakes them, from rest; afterwards the base stands still, and they swing freely.
    periods_s
        Undamped natural periods T [s].
    damping
        zeta, 1 being critical.
    displacement_m, velocity_m_s
        Sd [m] and Sv [m/s], relative to the ground.
    acceleration_m_s2
        Sa, of the total acceleration [m/s^2].
    """

    record: Record
    periods_s: Floats
    damping: float
    displacement_m: Floats
    velocity_m_s: Floats
    acceleration_m_s2: Floats

    @property
    def pseudo_velocity_m_s(self) -> Floats:
        """PSV = w Sd [m/s], with w = 2 pi/T."""
        velocity: Floats = 2.0 * math.pi / self.periods_s * self.displacement_m
        return velocity

    @property
    def pseudo_acceleration_m_s2(self) -> Floats:
        """PSA = w^2 Sd [m/s^2]: the spring's force over the mass, and Sa without damping."""
        acceleration: Floats = np.square(2.0 * math.pi / self.periods_s) * self.displacement_m
        return acceleration

    def to_dataset(self) -> "xarray.Dataset":
        """Return the ordinates as a Dataset over ``period_s``."""
        dataset: xarray.Dataset = words_module(ResponseSpectrum).spectrum_dataset(self)
        return dataset


@checked
def compute_response_spectrum(
    record: Record, periods_s: ArrayLike, *, damping: float = DAMPING
) -> ResponseSpectrum:
    """Compute the elastic response spectrum of a record.

    The recurrence of Nigam and Jennings (1969) is exact for an acceleration that is linear between
    its samples.  The peaks are exact too, and not those at the samples alone: between two of them
    they are where the derivative of the closed form is zero, and after the record those of the free
    swing.

    Parameters
    ----------
    record
        The record.
    periods_s
        Undamped natural periods [s], shape (periods,), above 0 and not below a hundredth of the
        record's interval.
    damping
        zeta, 1 being critical, in [0, 1); default 0.05.

    Returns
    -------
    ResponseSpectrum
        Relative displacement and velocity, total acceleration, and the pseudo-spectra.

    Raises
    ------
    InputError
        If a period or the damping is outside its range, or the record is beyond 1e50 m/s^2.

    References
    ----------
    N. C. Nigam and P. C. Jennings, Bull. Seism. Soc. Am. 59, 909-922 (1969).

    Examples
    --------
    A step of the acceleration doubles the displacement that it has in the end:

    >>> from rocksteady import Record
    >>> from rocksteady.measures import compute_response_spectrum
    >>> step = Record(acceleration_m_s2=[1.0] * 101, dt_s=0.01)
    >>> result = compute_response_spectrum(step, [0.5], damping=0.0)
    >>> result.pseudo_acceleration_m_s2.round(12), result.acceleration_m_s2.round(12)
    (array([2.]), array([2.]))
    """
    refuse_extreme(record)
    periods = np.atleast_1d(real_array("periods_s", periods_s))
    shortest = SHORTEST * record.dt_s
    wrong = ~((periods >= shortest) & (periods <= LONGEST_S))
    if periods.ndim != 1 or len(periods) == 0 or wrong.any():
        value = periods[wrong][0] if periods.ndim == 1 and wrong.any() else periods_s
        raise InputError(
            "periods_s",
            value,
            f"they must be finite, from {shortest:.3g} s for this record to {LONGEST_S:g} s",
            "give periods in seconds, as [0.1, 0.5, 1.0]",
        )
    ratio = in_range("damping", damping, 0.0, 1.0, "[)", hint="give 0.05 for 5 % of critical")
    # One closed form per period, in arrays over the samples.
    largest = np.array(
        [
            peaks(record.acceleration_m_s2, record.dt_s, 2.0 * math.pi / period, ratio)
            for period in periods.tolist()
        ]
    )
    return ResponseSpectrum(
        record=record,
        periods_s=periods,
        damping=ratio,
        displacement_m=largest[:, 0],
        velocity_m_s=largest[:, 1],
        acceleration_m_s2=largest[:, 2],
    )


@checked
def compute_average_acceleration(
    record: Record,
    period_s: Annotated[float, Bounds(0.0, LARGEST, "(]", "give a period in seconds")],
    *,
    damping: float = DAMPING,
    factors: tuple[float, float] = (0.2, 3.0),
    count: Annotated[int, Whole(2, 1000, "give 10")] = 10,
) -> float:
    """Return Sa_avg [m/s^2], the geometric mean of PSA over a range of periods.

    Parameters
    ----------
    record
        The record.
    period_s
        T [s].
    damping
        zeta, 1 being critical, in [0, 1); default 0.05.
    factors
        First and last period over T, ascending; default 0.2 and 3, as in [1]_.
    count
        Number of periods, from 2 to 1000.

    Raises
    ------
    InputError
        If an argument is outside its range.

    References
    ----------
    .. [1] L. Eads, E. Miranda and D. G. Lignos, Earthq. Eng. Struct. Dyn. 44, 2057-2073 (2015).

    Examples
    --------
    >>> from rocksteady import Record
    >>> from rocksteady.measures import compute_average_acceleration
    >>> record = Record(acceleration_m_s2=[0.0, 1.0, -1.0, 0.0], dt_s=0.1)
    >>> print(f"{compute_average_acceleration(record, 1.0):.6f}")
    0.189090
    """
    hint = "give two parts of T, as (0.2, 3.0)"
    low, high = (in_range("factors", end, 0.0, LARGEST, hint=hint) for end in factors)
    if low >= high:
        raise InputError("factors", factors, "its ends must ascend", "give (0.2, 3.0)")
    periods = period_s * np.linspace(low, high, count)
    spectrum = compute_response_spectrum(record, periods, damping=damping)
    return exp(float(np.mean(log(spectrum.pseudo_acceleration_m_s2))))


def peaks(acceleration: Floats, dt: float, frequency: float, damping: float) -> Floats:
    """Return the largest absolute displacement, velocity and total acceleration of an oscillator.

    They are those of `rocksteady.kernels.linear.oscillator.fill_largest`.

    Parameters
    ----------
    acceleration
        Acceleration of the ground, shape (samples,).
    dt
        Time between two of them.
    frequency
        w, circular, undamped; in the inverse of the unit of `dt`.
    damping
        zeta, in [0, 1).

    Returns
    -------
    ndarray, shape (3,)
        Of u and u' relative to the ground, and of u'' + a.
    """
    rate = rate_of(frequency, damping)
    # Steps of less than half a damped period: each derivative then has one extremum at most in it.
    parts = int(rate.imag * dt / math.pi) + 1
    a = np.array(acceleration)
    if parts > 1:
        within = np.diff(a)[:, np.newaxis] * (np.arange(parts) / parts)
        a = np.append(a[:-1, np.newaxis] + within, a[-1])
    largest, h = np.empty(3), dt / parts
    fill_largest(a, np.array(states(a, h, rate)), h, tuple(rate), largest)
    return largest
