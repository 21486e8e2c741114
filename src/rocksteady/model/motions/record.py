"""Recorded base motion: samples of acceleration in SI units."""

from dataclasses import dataclass, replace
from typing import Annotated

import numpy as np
from numpy.typing import ArrayLike

from rocksteady.arrays import Floats
from rocksteady.errors import InputError
from rocksteady.model.checks.arguments import checked
from rocksteady.model.checks.arrays import UnfitError, numeric_array
from rocksteady.model.checks.validation import LARGEST, in_range, positive
from rocksteady.model.motions.described_motion import DescribedMotion

SHORTEST = 1e-15
"""Of intervals between samples [s]; slopes of shorter ones overflow."""


def _samples(name: str, value: ArrayLike) -> Floats:
    """Return samples as an array of their own that cannot be written to."""
    hint = "give the samples of one component in m/s^2"
    try:
        given = np.asarray(numeric_array(name, value, None))
    except UnfitError as unfit:
        valid, hint = unfit.args
        raise InputError(name, value, valid, hint) from None
    except ValueError:  # rows of unequal lengths
        given = np.empty((0, 0))
    valid = ""
    if given.ndim != 1 or given.dtype.kind not in "iuf":
        valid = "it must be one row of numbers"
    elif len(given) < 2:
        valid = "it must have two samples or more"
    elif not np.isfinite(given).all():
        valid = f"sample {int(np.flatnonzero(~np.isfinite(given))[0])} is not a finite number"
    elif not given.any():
        valid, hint = "all samples are zero", "give a Still() for a base that does not move"
    if valid:
        raise InputError(name, value, valid, hint)
    samples = given.astype(np.float64)  # a copy
    samples.flags.writeable = False
    return samples


def _interval(name: str, value: object) -> float:
    """Return an interval between samples [s]."""
    hint = "give the time between samples in seconds"
    return in_range(name, positive(name, value, hint=hint), SHORTEST, LARGEST, "[]", hint=hint)


def _text(name: str, value: object) -> str:
    """Return a text."""
    if not isinstance(value, str):
        raise InputError(name, value, "it must be a text", "leave it out for none")
    return value


@checked
@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class Record(DescribedMotion):
    """Recorded base acceleration at equal intervals, linear between samples, then a still base.

    Positive acceleration drives positive rotation.

    Parameters
    ----------
    acceleration_m_s2
        Samples [m/s^2], shape (samples,), at least two and not all zero.  They are copied and
        cannot be changed.  The first acts at the start; after the last the base stands still.
    dt_s
        Interval between samples [s].
    name
        What to call the record; none by default.
    ground
        Record of the ground below, of a floor; none by default.

    Raises
    ------
    InputError
        If the samples are not a row of finite numbers, fewer than two or all zero, the interval is
        not positive, or the name is no text.

    Examples
    --------
    >>> record = Record(acceleration_m_s2=[0.0, 3.1, -1.2, 0.0], dt_s=0.02, name="example")
    >>> record
    Record(name='example', samples=4, dt_s=0.02, peak_acceleration_m_s2=3.1)
    >>> record.scaled(2.0).reversed().acceleration_m_s2.tolist()
    [-0.0, -6.2, 2.4, -0.0]
    """

    acceleration_m_s2: Annotated[Floats, _samples]
    dt_s: Annotated[float, _interval]
    name: Annotated[str | None, _text] = None
    ground: "Record | None" = None

    @property
    def reference(self) -> "Record":
        """The record whose measures are the levels of an ensemble: the ground below a floor."""
        return self if self.ground is None else self.ground

    @property
    def duration_s(self) -> float:
        """Time from the first sample to the last [s]."""
        return (len(self.acceleration_m_s2) - 1) * self.dt_s

    @property
    def peak_acceleration_m_s2(self) -> float:
        """Largest absolute acceleration [m/s^2]."""
        return float(np.abs(self.acceleration_m_s2).max())

    def scaled(self, factor: float) -> "Record":
        """Return the record with all accelerations multiplied by a factor; a negative one reverses.

        Raises
        ------
        InputError
            If the factor is 0, or its absolute value is not between 1e-50 and 1e50.
        """
        scale = in_range(
            "factor", factor, -LARGEST, LARGEST, "[]", hint="give a number; -1 reverses"
        )
        if scale == 0.0:
            raise InputError(
                "factor", factor, "it must not be 0", "give a Still() for a base that does not move"
            )
        if abs(scale) < 1.0 / LARGEST:
            raise InputError(
                "factor",
                factor,
                f"its absolute value must lie in [{1.0 / LARGEST:g}, {LARGEST:g}]",
                "give a number; -1 reverses",
            )
        below = None if self.ground is None else self.ground.scaled(scale)
        return replace(self, acceleration_m_s2=scale * self.acceleration_m_s2, ground=below)

    def reversed(self) -> "Record":
        """Return the record with the sign of all accelerations changed."""
        return self.scaled(-1.0)

    def __eq__(self, other: object) -> bool:
        """Return whether name, interval and every sample are the same."""
        if not isinstance(other, Record):
            return NotImplemented
        same = (self.name, self.dt_s, self.ground) == (other.name, other.dt_s, other.ground)
        return same and np.array_equal(self.acceleration_m_s2, other.acceleration_m_s2)

    def __hash__(self) -> int:
        """Return a hash that equal records share."""
        # Its sum is the same for -0.0 and 0.0, which its bytes are not.
        return hash((self.name, self.dt_s, float(self.acceleration_m_s2.sum())))

    def __repr__(self) -> str:
        """Return what it is, not all its samples."""
        return (
            f"Record(name={self.name!r}, samples={len(self.acceleration_m_s2)}, dt_s={self.dt_s}, "
            f"peak_acceleration_m_s2={self.peak_acceleration_m_s2:.6g})"
        )
