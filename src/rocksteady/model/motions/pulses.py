"""Single pulses of base motion, by name."""

import math
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Annotated

from rocksteady.errors import InputError, ModelError
from rocksteady.model.blocks.block import Block
from rocksteady.model.checks.arguments import checked
from rocksteady.model.checks.bounds import Bounds
from rocksteady.model.checks.validation import positive
from rocksteady.model.motions._pulse_shapes import SHAPES, listed, segments_of, type_c_of
from rocksteady.model.motions.described_motion import DescribedMotion
from rocksteady.model.motions.segments import (
    AMPLITUDE,
    HIGHEST_FREQUENCY_RATIO,
    LOWEST_FREQUENCY_RATIO,
    PHASE,
    Harmonic,
    Segment,
)

MOST_OSCILLATIONS = 50.0

HIGHEST_PULSE_RATIO = 0.5 * HIGHEST_FREQUENCY_RATIO
"""Some shapes hold sinusoids of up to twice their frequency."""

PULSES = {name: shape.words for name, shape in SHAPES.items()}
"""The shape of each named pulse in words; type-c4 and so on go on in the same way."""

LISTED_PULSES = listed()
"""The names of all shapes, by how long they last."""

PULSE_RATIO = Bounds(
    LOWEST_FREQUENCY_RATIO,
    HIGHEST_PULSE_RATIO,
    "[]",
    "give omega/p, 2 pi over the pulse's period over the block's p",
)
TOLERANCE = Bounds(1e-8, 0.1, "[]", "give a small part of the amplitude, as 1e-6")
"""Wavelets are not sampled finer: a Ricker wavelet is then 90 000 lines."""

_OF_ONE_SHAPE = {
    "oscillations": Bounds(
        1.0, MOST_OSCILLATIONS, "(]", "give gamma, about the number of half cycles; 2 is usual"
    ),
    "phase": PHASE,
}


def _known(name: str, value: object) -> str:
    """Return the name of a pulse."""
    if not isinstance(value, str) or (value not in PULSES and type_c_of(value) is None):
        raise InputError(
            name,
            value,
            "there is no pulse of that name",
            "choose one of " + ", ".join(PULSES) + ", or type-c4 to type-c99",
        )
    return value


@checked
@dataclass(frozen=True, kw_only=True)
class Pulse(DescribedMotion):
    """A single pulse of base acceleration, followed by a still base.

    Positive acceleration drives positive rotation, as everywhere in the package; in [1]_ the
    rotation has the opposite sign.  `motions.delay`, `motions.join` and `motions.add` put pulses
    together.

    Parameters
    ----------
    shape
        Its name: rectangle, half-sine, versed-sine, triangle or decaying-ramp, which last
        half a period; one-sine or one-cosine, a period; type-c1, type-c2, ... [1]_; and the
        wavelets ricker, ricker-antisymmetric [2]_ and mavroeidis-papageorgiou [3]_.
    amplitude
        Largest base acceleration over alpha g, from 0 to 1e50; below 1 a block at rest stays there.
    frequency_ratio
        Omega = omega/p, from 0.01 to 5000, with omega = 2 pi over the pulse's period.  For a pulse
        that lasts half a period, `lasting` takes the duration.
    oscillations, phase
        gamma (above 1, up to 50; default 2) and nu ([rad], default 0) of mavroeidis-papageorgiou.
    tolerance
        Wavelets are straight lines between samples, nowhere further from the wavelet than this part
        of the amplitude.  Other shapes are exact.
    reverse
        Whether the pulse has the other sign; default False.

    Raises
    ------
    InputError
        If there is no such shape, or a number is outside its range.
    ModelError
        If another shape than mavroeidis-papageorgiou has oscillations or a phase.

    Examples
    --------
    >>> Pulse(shape="one-sine", amplitude=2.0, frequency_ratio=5.0).duration
    1.2566370614359172

    References
    ----------
    .. [1] N. Makris and Y. S. Roussos, Geotechnique 50, 243-262 (2000).
    .. [2] M. F. Vassiliou and N. Makris, Bull. Seism. Soc. Am. 101, 596-618 (2011).
    .. [3] G. P. Mavroeidis and A. S. Papageorgiou, Bull. Seism. Soc. Am. 93, 1099-1131 (2003).
    """

    shape: Annotated[str, _known]
    amplitude: Annotated[float, AMPLITUDE]
    frequency_ratio: Annotated[float, PULSE_RATIO]
    oscillations: float | None = None
    phase: float | None = None
    tolerance: Annotated[float, TOLERANCE] = 1e-6
    reverse: bool = False

    def __post_init__(self) -> None:
        """Validate what one shape alone has."""
        for name, rule in _OF_ONE_SHAPE.items():
            value = getattr(self, name)
            if value is not None and self.shape != "mavroeidis-papageorgiou":
                raise ModelError(
                    name,
                    value,
                    f"a {self.shape} pulse has none",
                    "leave it out, or take the shape mavroeidis-papageorgiou",
                )
            if value is not None:
                object.__setattr__(self, name, rule(name, value))

    @classmethod
    def lasting(cls, duration: float, *, shape: str, amplitude: float) -> "Pulse":
        """Return the pulse of a shape that lasts a given pivot time.

        Parameters
        ----------
        duration
            Pivot time p t: of 0.5 s, ``0.5 * block.p``.
        shape, amplitude
            As for `Pulse`.

        Raises
        ------
        InputError
            As for the pulse.

        Examples
        --------
        >>> Pulse.lasting(1.0, shape="half-sine", amplitude=2.4).frequency_ratio
        3.141592653589793
        """
        length = positive("duration", duration, hint="give the pivot time p t that it lasts")
        unit = cls(shape=shape, amplitude=amplitude, frequency_ratio=1.0)
        return cls(shape=shape, amplitude=amplitude, frequency_ratio=unit.duration / length)

    @classmethod
    def from_si(
        cls,
        block: Block,
        *,
        shape: str,
        acceleration_m_s2: float,
        frequency_hz: float,
        oscillations: float | None = None,
        phase: float | None = None,
        reverse: bool = False,
    ) -> "Pulse":
        """Return a pulse in the measures of a given block.

        Parameters
        ----------
        block
            The block that is shaken; its alpha, p and g set the scales.
        shape, oscillations, phase, reverse
            As for `Pulse`.
        acceleration_m_s2
            Largest base acceleration [m/s^2].
        frequency_hz
            One over the pulse's period [Hz].

        Raises
        ------
        InputError, ModelError
            As for the pulse, in the measures given.

        Examples
        --------
        >>> block = Block.from_p(alpha=0.2, p=6.283185307179586)
        >>> Pulse.from_si(
        ...     block, shape="one-sine", acceleration_m_s2=3.92266, frequency_hz=4.0
        ... ).frequency_ratio
        4.0
        """
        felt = Harmonic.from_si(
            block, acceleration_m_s2=acceleration_m_s2, frequency_hz=frequency_hz
        )
        return cls(
            shape=shape,
            amplitude=felt.amplitude,
            frequency_ratio=felt.frequency_ratio,
            oscillations=oscillations,
            phase=phase,
            reverse=reverse,
        )

    def acceleration_m_s2(self, block: Block) -> float:
        """Return the largest base acceleration for a block [m/s^2]."""
        return self.amplitude * block.uplift_acceleration

    def frequency_hz(self, block: Block) -> float:
        """Return one over the pulse's period for a block [Hz]."""
        return self.frequency_ratio * block.p / (2.0 * math.pi)

    @property
    def duration(self) -> float:
        """Pivot time p t that the pulse lasts."""
        return math.fsum(piece.duration for piece in self._pieces)

    def segments(self) -> tuple[Segment, ...]:
        """Return the segments: one or two in closed form, or the lines of a wavelet."""
        return self._pieces

    @cached_property
    def _pieces(self) -> tuple[Segment, ...]:
        """The segments, made once."""
        made = segments_of(
            self.shape,
            self.amplitude,
            self.frequency_ratio,
            tolerance=self.tolerance,
            oscillations=2.0 if self.oscillations is None else self.oscillations,
            phase=0.0 if self.phase is None else self.phase,
        )
        return tuple(map(_turned, made)) if self.reverse else made


def _turned(piece: Segment) -> Segment:
    """Return a segment with the other sign."""
    return replace(
        piece,
        constant=-piece.constant,
        slope=-piece.slope,
        amplitude=-piece.amplitude,
        jump=-piece.jump,
    )
