"""Ground acceleration, velocity and displacement of a record, integrated exactly.

Between two samples the acceleration is a line, so that velocity is a parabola, displacement a cubic
and the energy of the acceleration a cubic too.  Nothing is left out but rounding; where a velocity
or a displacement is largest inside a sample, that is where its derivative has its zero.
"""

import math
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from rocksteady.arrays import Floats
from rocksteady.kernels.elementary.arrays import exp, log
from rocksteady.model.blocks.gravity import STANDARD_GRAVITY
from rocksteady.model.checks.arguments import checked, checked_result
from rocksteady.model.checks.validation import LARGEST, in_range
from rocksteady.model.motions.record import Record
from rocksteady.results.result import Result, words_module

if TYPE_CHECKING:
    import pandas as pd
    import xarray


DRIFT = 0.05
"""Velocity at the end over the largest one above which a record counts as drifting."""
SLOWEST_S = 5.0
"""PGD over PGV [s] from which on it is; 1.4 s is the most of 66 records of PEER."""


@checked_result
@dataclass(frozen=True, kw_only=True)
class Peak:
    """Largest absolute value, with its sign and its time.

    Attributes
    ----------
    value
        With its sign, in the unit of the quantity.
    t_s
        Time [s].
    """

    value: float
    t_s: float


@checked_result
@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class IntegratedRecord(Result):
    """Ground motion at every sample of a record, starting from rest.

    Attributes
    ----------
    record
        The record.
    t_s
        Times of the samples [s], shape (samples,), as all that follows.
    velocity_m_s, displacement_m
        Integrals of the acceleration [m/s], [m].
    arias_m_s
        Arias intensity up to then, pi/(2 g) times the integral of the squared acceleration [m/s].
    """

    record: Record
    t_s: Floats
    velocity_m_s: Floats
    displacement_m: Floats
    arias_m_s: Floats

    @property
    def acceleration_m_s2(self) -> Floats:
        """The samples [m/s^2]."""
        return self.record.acceleration_m_s2

    @cached_property
    def peak_acceleration(self) -> Peak:
        """PGA [m/s^2]: of lines, always at a sample."""
        return _largest(self.acceleration_m_s2, self.t_s)

    @cached_property
    def peak_velocity(self) -> Peak:
        """PGV [m/s], exact: at a sample, or where the acceleration crosses zero between two."""
        a0, a1 = self.acceleration_m_s2[:-1], self.acceleration_m_s2[1:]
        inside = np.flatnonzero(a0 * a1 < 0.0)
        since = a0[inside] / (a0[inside] - a1[inside]) * self.record.dt_s
        values = self.velocity_m_s[inside] + 0.5 * a0[inside] * since
        return _largest(
            np.concatenate([self.velocity_m_s, values]),
            np.concatenate([self.t_s, self.t_s[inside] + since]),
        )

    @cached_property
    def peak_displacement(self) -> Peak:
        """PGD [m], exact: at a sample, or where the velocity is zero between two."""
        h = self.record.dt_s
        a, v = self.acceleration_m_s2[:-1], self.velocity_m_s[:-1]
        slope = np.diff(self.acceleration_m_s2) / h
        # Zeros of v + a t + slope t^2/2, in the form of the quadratic that does not cancel.
        root = a * a - 2.0 * slope * v
        q = -(a + np.copysign(np.sqrt(np.maximum(root, 0.0)), a))
        with np.errstate(divide="ignore", invalid="ignore"):
            zeros = np.stack([q / slope, 2.0 * v / q])
        here = (root >= 0.0) & (zeros > 0.0) & (zeros < h)
        at = np.nonzero(here)[1]
        t = zeros[here]
        values = self.displacement_m[at] + t * (v[at] + t * (a[at] / 2.0 + t * slope[at] / 6.0))
        return _largest(
            np.concatenate([self.displacement_m, values]),
            np.concatenate([self.t_s, self.t_s[at] + t]),
        )

    def to_dataset(self) -> "xarray.Dataset":
        """Return the samples as a Dataset over ``t_s``."""
        dataset: xarray.Dataset = words_module(IntegratedRecord).integrated_dataset(self)
        return dataset

    def to_dataframe(self) -> "pd.DataFrame":
        """Return one row per sample."""
        return self.to_dataset().to_dataframe().reset_index()

    @property
    def drifts(self) -> bool:
        """Whether the displacement comes from an error in the baseline.

        True where the ground ends with more than a twentieth of its largest velocity, which a real
        ground does not; or where PGD is more than 5 s times PGV, as with swings of 30 s and longer,
        the rest of a drift whose mean has been removed.
        """
        largest = abs(self.peak_velocity.value)
        ending = abs(float(self.velocity_m_s[-1])) > DRIFT * largest
        return ending or abs(self.peak_displacement.value) > SLOWEST_S * largest

    @cached_property
    def husid(self) -> Floats:
        """Husid's curve: the part of the Arias intensity reached at each sample, from 0 to 1."""
        ratio: Floats = self.arias_m_s / self.arias_m_s[-1]
        return ratio

    def time_of_arias(self, part: float) -> float:
        """Return when a part of the Arias intensity is reached [s], exact inside a sample too.

        Parameters
        ----------
        part
            In (0, 1].

        Raises
        ------
        InputError
            If it is not.
        """
        part = in_range("part", part, 0.0, 1.0, "(]", hint="give a part of the whole, as 0.05")
        scale = 2.0 * STANDARD_GRAVITY / np.pi
        target = part * self.arias_m_s[-1]
        # The last one is left out: rounding must not put the end behind the record.
        at = int(np.searchsorted(self.arias_m_s[1:-1], target, side="left"))
        missing = float(scale * (target - self.arias_m_s[at]))
        first, last = self.acceleration_m_s2[at : at + 2].tolist()
        slope = (last - first) / self.record.dt_s
        # The integral of a^2 is (a(t)^3 - first^3)/(3 slope); solved for t without a difference.
        then = _cube_root(first * first * first + 3.0 * slope * missing)
        square = then * then + then * first + first * first
        since = 3.0 * missing / square if square > 0.0 else 0.0
        return float(self.t_s[at]) + min(since, self.record.dt_s)


@checked
def integrate_record(record: Record) -> IntegratedRecord:
    """Integrate a record to velocity and displacement of the ground, from rest.

    The acceleration is linear between its samples, and is integrated exactly.

    Parameters
    ----------
    record
        The record.

    Returns
    -------
    IntegratedRecord
        Velocity, displacement and Arias intensity at each sample, and exact peaks between them.

    Raises
    ------
    InputError
        If the largest acceleration is beyond 1e50 m/s^2, or below 1e-50: powers of it are needed.

    Examples
    --------
    >>> from rocksteady import Record
    >>> from rocksteady.measures import integrate_record
    >>> course = integrate_record(Record(acceleration_m_s2=[1.0, 1.0, -1.0, -1.0], dt_s=1.0))
    >>> course.velocity_m_s.tolist(), course.peak_velocity
    ([0.0, 1.0, 1.0, 0.0], Peak(value=1.25, t_s=1.5))
    """
    refuse_extreme(record)
    a, h = record.acceleration_m_s2, record.dt_s
    a0, a1 = a[:-1], a[1:]
    velocity = _summed(0.5 * h * (a0 + a1))
    displacement = _summed(h * velocity[:-1] + h * h / 6.0 * (2.0 * a0 + a1))
    energy = _summed(h / 3.0 * (a0 * a0 + a0 * a1 + a1 * a1))
    return IntegratedRecord(
        record=record,
        t_s=h * np.arange(len(a), dtype=np.float64),
        velocity_m_s=velocity,
        displacement_m=displacement,
        arias_m_s=np.pi / (2.0 * STANDARD_GRAVITY) * energy,
    )


def refuse_extreme(record: Record) -> None:
    """Refuse a record whose squares would overflow, or be lost.

    Raises
    ------
    InputError
        If its largest acceleration is beyond 1e50 m/s^2, or below 1e-50.
    """
    largest, hint = record.peak_acceleration_m_s2, "give the accelerations in m/s^2"
    in_range("acceleration_m_s2", largest, 1.0 / LARGEST, LARGEST, "[]", hint=hint)


def _cube_root(value: float) -> float:
    """Return the real cube root: a first one, and a step of Newton's method."""
    if value == 0.0:
        return 0.0
    size = exp(log(abs(value)) / 3.0)
    return math.copysign(size - (size - abs(value) / (size * size)) / 3.0, value)


def _summed(steps: Floats) -> Floats:
    """Return running sums that begin at 0."""
    return np.concatenate([[0.0], np.cumsum(steps)])


def _largest(values: Floats, t_s: Floats) -> Peak:
    """Return the first of the largest absolute values."""
    at = int(np.argmax(np.abs(values)))
    return Peak(value=float(values[at]), t_s=float(t_s[at]))
