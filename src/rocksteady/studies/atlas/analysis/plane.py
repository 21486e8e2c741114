"""Region of the plane of frequency and amplitude that an atlas covers."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from rocksteady import DimensionlessBlock, Harmonic, Steady
from rocksteady.arrays import Floats
from rocksteady.errors import InputError

AMPLITUDES = np.linspace(0.08, 8.0, 100)
FREQUENCY_RATIOS = np.linspace(0.075, 12.0, 160)
"""Defaults: all that is stable for n = 1, 3, 5 at the restitutions of the literature."""
ORDERS = (1, 3, 5)
HIGHEST_AMPLITUDE = 1000.0
HINT = "give start:stop:count on the command line, numpy.linspace(start, stop, count) here"


@dataclass(frozen=True, kw_only=True, eq=False)
class Plane:
    """Amplitudes and frequency ratios, evenly spaced, for one restitution.

    Parameters
    ----------
    restitution
        Ratio of angular velocities, in (0, 1): without loss nothing is attracted.
    amplitude
        A = a_max/(alpha g), shape (rows,): three or more, ascending, above 0.
    frequency_ratio
        Omega = omega/p, shape (columns,): likewise.
    orders
        Half periods n of the shaking in a half cycle of the families that are followed, odd.

    Raises
    ------
    InputError
        If a value is anything else.

    Examples
    --------
    >>> plane = Plane(restitution=0.8, amplitude=[1.0, 2.0, 3.0], frequency_ratio=[2.0, 4.0, 6.0])
    >>> plane.window
    (1.0, 7.0, 0.5, 3.5)
    """

    restitution: float
    amplitude: ArrayLike = ()
    frequency_ratio: ArrayLike = ()
    orders: tuple[int, ...] = ORDERS

    def __post_init__(self) -> None:
        """Validate, and keep the axes as read-only arrays."""
        block = DimensionlessBlock(restitution=self.restitution)
        if block.lossless:
            valid = "it must lie in (0, 1)"
            hint = "give a ratio of velocities below 1, as 0.8; without loss nothing is attracted"
            raise InputError("restitution", self.restitution, valid, hint)
        object.__setattr__(self, "restitution", block.restitution)
        for name in ("amplitude", "frequency_ratio"):
            object.__setattr__(self, name, _axis(name, getattr(self, name)))
        for end in (self.amplitudes[0], self.amplitudes[-1]):
            if not 0.0 < end <= HIGHEST_AMPLITUDE:
                valid = f"it must lie in (0, {HIGHEST_AMPLITUDE:g}]"
                raise InputError("amplitude", float(end), valid, HINT)
        for ratio in (self.ratios[0], self.ratios[-1]):
            Harmonic(amplitude=1.0, frequency_ratio=float(ratio))  # refuses what is out of range
        orders = tuple(sorted({Steady(order=order).order for order in self.orders}))
        if not orders:
            hint = "give orders=(1, 3, 5)"
            raise InputError("orders", (), "there is one or more", hint)
        object.__setattr__(self, "orders", orders)

    @property
    def amplitudes(self) -> Floats:
        """The rows, shape (rows,)."""
        return np.asarray(self.amplitude, dtype=np.float64)

    @property
    def ratios(self) -> Floats:
        """The columns, shape (columns,)."""
        return np.asarray(self.frequency_ratio, dtype=np.float64)

    @property
    def top(self) -> float:
        """Upper edge of the highest cells."""
        return self.window[3]

    @property
    def window(self) -> tuple[float, float, float, float]:
        """Edges of the outermost cells: Omega from, to; A from, to."""
        edges = []
        for points in (self.ratios, self.amplitudes):
            half = 0.5 * (points[1] - points[0])
            edges += [max(float(points[0] - half), 0.0), float(points[-1] + half)]
        return edges[0], edges[1], edges[2], edges[3]


def _axis(name: str, values: ArrayLike) -> Floats:
    """Return an axis of the plane."""
    points = np.array(values, dtype=np.float64)
    if points.ndim != 1 or points.size < 3:
        valid = "an axis of the plane has three values or more"
        raise InputError(name, points.tolist(), valid, HINT)
    steps = np.diff(points)
    if not ((steps > 0.0).all() and np.ptp(steps) <= 1e-6 * steps.mean()):
        valid = "the values of an axis ascend and are evenly spaced"
        raise InputError(name, points.tolist(), valid, HINT)
    points.flags.writeable = False
    return points
