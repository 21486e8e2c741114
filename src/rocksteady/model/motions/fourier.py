"""Periodic base motions: any shaking that repeats itself, as a Fourier series."""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Annotated, Self

from rocksteady.errors import InputError
from rocksteady.kernels.elementary.arrays import atan2, hypot, sincos
from rocksteady.model.blocks.block import Block
from rocksteady.model.checks.arguments import checked
from rocksteady.model.checks.validation import LARGEST, whole_number
from rocksteady.model.motions.described_motion import DescribedMotion
from rocksteady.model.motions.harmonics import HIGHEST_ORDER, Harmonics, harmonics_value
from rocksteady.model.motions.segments import (
    AMPLITUDE,
    FREQUENCY_RATIO,
    HIGHEST_FREQUENCY_RATIO,
    PHASE,
    Harmonic,
    Segment,
)

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

    from rocksteady.arrays import Floats

CELLS = 32
"""Parts of the shortest wave in which the peak is looked for."""
SMALLEST_SHARE = 1e-12
"""Of the largest harmonic of samples, below which one is rounding and left out."""
MOST_SAMPLES = 1_000_000
ORDERS = 16
"""Highest order of a series of samples, by default."""


@checked
@dataclass(frozen=True, kw_only=True)
class FourierSeries(DescribedMotion):
    """Endless periodic shaking, ``A sum a_k sin(k (Omega s + phase) + phi_k)``.

    Its mean is zero.  It repeats itself after a pivot time of 2 pi/Omega.

    Parameters
    ----------
    amplitude
        A, which scales all harmonics, in units of alpha g, from 0 to 1e50.
    frequency_ratio
        Omega = omega/p of the period, from 0.01 to 10 000.
    harmonics
        Triples (k, a_k, phi_k): order, from 1 to 64 and each at most once, size relative to A, and
        phase [rad].  The highest may not be faster than 10 000 p.
    phase
        Phase of the period at the start [rad].

    Raises
    ------
    InputError
        If a number is outside its range, an order stands twice, or there is no harmonic.

    Examples
    --------
    >>> motion = FourierSeries(
    ...     amplitude=1.2, frequency_ratio=4.0, harmonics=((1, 1.0, 0.0), (2, 0.5, 0.0))
    ... )
    >>> print(f"{motion.peak:.6f} {motion.peak_phase:.6f}")
    1.558846 1.047198
    """

    amplitude: Annotated[float, AMPLITUDE]
    frequency_ratio: Annotated[float, FREQUENCY_RATIO]
    harmonics: Harmonics
    phase: Annotated[float, PHASE] = 0.0

    def __post_init__(self) -> None:
        """Validate the harmonics."""
        waves = harmonics_value(self.harmonics)
        object.__setattr__(self, "harmonics", waves)
        if waves[-1][0] * self.frequency_ratio > HIGHEST_FREQUENCY_RATIO:
            raise InputError(
                "frequency_ratio",
                self.frequency_ratio,
                f"the harmonic of order {waves[-1][0]} may be at most "
                f"{HIGHEST_FREQUENCY_RATIO:g} p fast",
                "lower the frequency, or leave out the highest orders",
            )

    @classmethod
    def from_si(
        cls,
        block: Block,
        *,
        acceleration_m_s2: float,
        frequency_hz: float,
        harmonics: Harmonics,
        phase: float = 0.0,
    ) -> Self:
        """Return the shaking of a given block in its own measures.

        Parameters
        ----------
        block
            The block that is shaken; its alpha, p and g set the scales.
        acceleration_m_s2
            What the sizes of the harmonics are multiplied by [m/s^2].
        frequency_hz
            Frequency of the period [Hz].
        harmonics, phase
            As for `FourierSeries`.

        Raises
        ------
        InputError
            If a number is outside its range.

        Examples
        --------
        >>> block = Block.from_p(alpha=0.2, p=6.283185307179586)
        >>> motion = FourierSeries.from_si(
        ...     block, acceleration_m_s2=3.92266, frequency_hz=4.0, harmonics=((3, 1.0, 0.0),)
        ... )
        >>> round(motion.amplitude, 12), round(motion.frequency_ratio, 12)
        (2.0, 4.0)
        """
        scale = Harmonic.from_si(
            block, acceleration_m_s2=acceleration_m_s2, frequency_hz=frequency_hz, phase=phase
        )
        return cls(
            amplitude=scale.amplitude,
            frequency_ratio=scale.frequency_ratio,
            harmonics=harmonics,
            phase=phase,
        )

    @classmethod
    def from_samples(
        cls, samples: "ArrayLike", *, frequency_ratio: float, orders: int | None = None
    ) -> Self:
        """Return the series of one period of equally spaced samples.

        The mean is left out, and so are orders above `orders`: `misfit` measures how far the series
        is from the samples.

        Parameters
        ----------
        samples
            Base acceleration in units of alpha g, shape (samples,), 3 or more; the next one would
            repeat the first.
        frequency_ratio
            Omega = omega/p of the period.
        orders
            Highest order, from 1 to 64 and below half the number of samples; default 16, or the
            highest that fewer samples allow.

        Raises
        ------
        InputError
            If a number is outside its range, or nothing but a mean is in the samples.

        Examples
        --------
        >>> import numpy as np
        >>> triangle = np.abs(np.arange(-8, 8)) / 4.0 - 1.0
        >>> motion = FourierSeries.from_samples(triangle, frequency_ratio=2.0, orders=3)
        >>> [(k, round(size, 4)) for k, size, _ in motion.harmonics]
        [(1, 0.8211), (3, 0.1012)]
        >>> print(f"{motion.misfit(triangle):.4f}")
        0.0777
        """
        import numpy as np

        values = _period(samples)
        most = min(HIGHEST_ORDER, (len(values) - 1) // 2)
        hint = f"{len(values)} samples determine at most {most} orders"
        asked = min(ORDERS, most) if orders is None else orders
        count = whole_number("orders", asked, at_least=1, at_most=most, hint=hint)
        turn = np.arange(len(values)) * (2.0 * math.pi / len(values))
        harmonics: list[tuple[int, float, float]] = []
        for k in range(1, count + 1):
            sine, cosine = sincos(np.remainder(k * turn, 2.0 * math.pi))
            p = 2.0 * math.fsum(values * sine) / len(values)
            q = 2.0 * math.fsum(values * cosine) / len(values)
            harmonics.append((k, float(hypot(p, q)), float(atan2(q, p))))
        largest = max(size for _, size, _ in harmonics)
        kept = tuple(wave for wave in harmonics if wave[1] > SMALLEST_SHARE * largest)
        # Of equal samples rounding leaves harmonics, each a part of the largest of them.
        if not kept or bool((values == values[0]).all()):
            raise InputError(
                "samples",
                samples,
                "they must differ from their mean",
                "give one period of the acceleration, in units of alpha g",
            )
        return cls(amplitude=1.0, frequency_ratio=frequency_ratio, harmonics=kept)

    def misfit(self, samples: "ArrayLike") -> float:
        """Return the largest difference from one period of samples, less their mean [alpha g].

        Raises
        ------
        InputError
            If there are fewer than 3 samples, or one is not finite.
        """
        import numpy as np

        values = _period(samples)
        turn = np.arange(len(values), dtype=np.float64) * (2.0 * math.pi / len(values))
        difference = self.amplitude * self._shape(turn)[0] - (
            values - math.fsum(values) / len(values)
        )
        return float(np.abs(difference).max())

    def acceleration(self, phase: "ArrayLike") -> "Floats":
        """Return the base acceleration at phases of the period [rad], in units of alpha g.

        Raises
        ------
        InputError
            If a phase is not finite.
        """
        return self.amplitude * self._shape(_real("phase", phase))[0]

    @property
    def orders(self) -> tuple[int, ...]:
        """Orders of the harmonics, the lowest first."""
        return tuple(order for order, _, _ in self.harmonics)

    @property
    def antisymmetric(self) -> bool:
        """Whether half a period later the shaking is its own negative: all orders are odd."""
        return all(order % 2 == 1 for order in self.orders)

    @property
    def peak(self) -> float:
        """Largest base acceleration, in units of alpha g; 1 just lifts a block at rest."""
        return self.amplitude * self._crest[0]

    @property
    def peak_phase(self) -> float:
        """Phase of the period at which the acceleration is largest, in [0, 2 pi) [rad]."""
        return self._crest[1]

    @cached_property
    def _crest(self) -> tuple[float, float]:
        """Largest |acceleration|/A, and where.

        Between neighbours h apart the shape exceeds their larger value by h^2/8 times a bound of
        its second derivative at most: only cells that may hold the largest are looked into.
        """
        import numpy as np

        count = CELLS * self.orders[-1]
        width = 2.0 * math.pi / count
        turn: Floats = width * np.arange(count, dtype=np.float64)
        value, slope = self._shape(turn)
        size = np.abs(value)
        rise = slope * np.sign(value)
        later, rise_later = np.roll(size, -1), np.roll(rise, -1)
        bend = math.fsum(abs(a) * k * k for k, a, _ in self.harmonics)
        best = int(np.argmax(size))
        crest, place = float(size[best]), float(turn[best])
        may = np.maximum(size, later) + bend * width * width / 8.0 > crest
        for cell in np.flatnonzero(may & (rise > 0.0) & (rise_later < 0.0)):
            low, high = float(turn[cell]), float(turn[cell]) + width
            sign = math.copysign(1.0, float(value[cell]))
            for _ in range(80):
                middle = 0.5 * (low + high)
                if not low < middle < high:
                    break
                if sign * float(self._shape(middle)[1]) > 0.0:
                    low = middle
                else:
                    high = middle
            height = abs(float(self._shape(low)[0]))
            if height > crest:
                crest, place = height, low
        return crest, place

    def _shape(self, turn: "Floats | float") -> tuple["Floats", "Floats"]:
        """Return acceleration/A and its derivative by the phase."""
        import numpy as np

        value, slope = np.zeros(np.shape(turn)), np.zeros(np.shape(turn))
        for order, size, phase in self.harmonics:
            sine, cosine = sincos(order * np.asarray(turn) + phase)
            value = value + size * sine
            slope = slope + order * size * cosine
        return value, slope

    def acceleration_m_s2(self, block: Block) -> float:
        """Return the peak base acceleration for a block [m/s^2]."""
        return self.peak * block.uplift_acceleration

    def frequency_hz(self, block: Block) -> float:
        """Return the frequency of the period for a block [Hz]."""
        return self.frequency_ratio * block.p / (2.0 * math.pi)

    def segments(self) -> tuple[Segment, ...]:
        """Return the one endless segment."""
        return (
            Segment(
                duration=math.inf,
                amplitude=self.amplitude,
                frequency=self.frequency_ratio,
                phase=self.phase,
                harmonics=self.harmonics,
            ),
        )


PeriodicMotion = Harmonic | FourierSeries
"""Shaking that repeats itself: by its period orbits and attractors are counted."""


def _real(name: str, given: "ArrayLike") -> "Floats":
    """Return an array of real, finite numbers."""
    import numpy as np

    try:
        values = np.asarray(given, dtype=np.float64)
    except (TypeError, ValueError):
        values = np.array(math.nan)
    if not np.isfinite(values).all() or (np.abs(values) > LARGEST).any():
        raise InputError(name, given, "they must be real, finite numbers", "give numbers")
    return values


def _period(samples: "ArrayLike") -> "Floats":
    """Return the samples of one period."""
    values = _real("samples", samples)
    if values.ndim != 1 or not 3 <= len(values) <= MOST_SAMPLES:
        raise InputError(
            "samples",
            f"shape {values.shape}",
            f"it must be a row of 3 to {MOST_SAMPLES} numbers",
            "give one period of the acceleration, in units of alpha g",
        )
    return values


def harmonics_of(motion: object) -> Harmonics:
    """Return the harmonics of a Fourier series; none of any other motion."""
    return motion.harmonics if isinstance(motion, FourierSeries) else ()


def largest_amplitude(motion: PeriodicMotion) -> float:
    """Return an upper bound of the base acceleration: A, of a series times the sum of its sizes."""
    if isinstance(motion, Harmonic):
        return motion.amplitude
    return motion.amplitude * math.fsum(abs(size) for _, size, _ in motion.harmonics)


def shares_of(harmonics: Sequence[tuple[int, float, float]]) -> tuple[float, "Floats"]:
    """Return the sum of the sizes, and the shares over it as `kernels.core.harmonics` has them."""
    import numpy as np

    total = math.fsum(abs(size) for _, size, _ in harmonics)
    shares = np.zeros(2 * max(order for order, _, _ in harmonics))
    for order, size, phase in harmonics:
        sine, cosine = sincos(phase)
        shares[2 * order - 2] = size * cosine / total
        shares[2 * order - 1] = size * sine / total
    return total, shares
