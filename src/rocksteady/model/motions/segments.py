"""Base motions and their segments, the only form of motion that the kernels accept.

A segment of the base acceleration, in units of ``alpha g`` over pivot time ``s = p t``, is
``c0 + c1 s + A sin(Omega s + phi)``, with an optional jump of the velocity at its start.
"""

import math
from dataclasses import dataclass, field
from functools import partial
from typing import Annotated, Protocol

from rocksteady.errors import InputError, ModelError
from rocksteady.model.blocks.block import Block
from rocksteady.model.checks.arguments import checked
from rocksteady.model.checks.bounds import INSIDE, Bounds
from rocksteady.model.checks.validation import LARGEST, in_range, non_negative, positive
from rocksteady.model.motions.described_motion import DescribedMotion
from rocksteady.model.motions.harmonics import LARGEST_PHASE, Harmonics, harmonics_value

LOWEST_FREQUENCY_RATIO = 0.01
HIGHEST_FREQUENCY_RATIO = 1.0e4

LONGEST_DURATION = 1.0e6
"""Pivot time of the longest segment that is not endless."""

PI_LOW = 1.2246467991473532e-16
"""pi less the double that stands for it."""


AMPLITUDE = Bounds(0.0, LARGEST, "[]", "give a_max/(alpha g); 1 just lifts a block")
FREQUENCY_RATIO = Bounds(
    LOWEST_FREQUENCY_RATIO,
    HIGHEST_FREQUENCY_RATIO,
    "[]",
    "give omega/p, the circular frequency of the shaking over the block's p",
)
PHASE = Bounds(-LARGEST_PHASE, LARGEST_PHASE, "[]", "give radians, less whole turns")

RMS = Bounds(0.0, LARGEST, "[]", "give it over alpha g")
DURATION_S = partial(positive, hint="give it in seconds")

_SIZE = Bounds(-LARGEST, LARGEST, "[]", "give a number in units of alpha g and of p")

_FREQUENCY = Bounds(0.0, HIGHEST_FREQUENCY_RATIO, "[]", "give omega/p")


def _lasting(name: str, value: object) -> float:
    """Return the duration of a segment, which may be infinite."""
    if isinstance(value, float) and value == math.inf:
        return value
    hint = "give the pivot time p t that the segment lasts"
    return in_range(name, value, 0.0, LONGEST_DURATION, hint=hint)


@checked
@dataclass(frozen=True, kw_only=True)
class Segment:
    """One piece of base acceleration, ``constant + slope s + amplitude sin(frequency s + phase)``.

    With harmonics it is ``amplitude sum a_k sin(k (frequency s + phase) + phi_k)``.

    Parameters
    ----------
    duration
        In pivot time s = p t, counted from the segment's start; may be infinite.
    constant, slope, amplitude
        Base acceleration in units of alpha g (the slope per unit of s).
    frequency, phase
        Omega = omega/p, and the phase [rad] at the segment's start.
    jump
        Change of the block's velocity d(theta/alpha)/ds at the segment's start, by an impulse of
        the base.
    harmonics
        Triples (k, a_k, phi_k) of order, size and phase of a Fourier series in place of the
        sinusoid; none by default.

    Raises
    ------
    InputError
        If a number is not finite or above 1e50, the duration is not positive or above 1e6 and
        finite, the frequency negative or above 10 000, or the phase beyond 1e6.
    ModelError
        If an endless segment has a slope, a sinusoid has no frequency, or harmonics meet a constant
        or a slope.
    """

    duration: Annotated[float, _lasting]
    constant: Annotated[float, _SIZE] = 0.0
    slope: Annotated[float, _SIZE] = 0.0
    amplitude: Annotated[float, _SIZE] = 0.0
    frequency: Annotated[float, _FREQUENCY] = 0.0
    phase: Annotated[float, PHASE] = 0.0
    jump: Annotated[float, _SIZE] = 0.0
    harmonics: Harmonics = ()

    def __post_init__(self) -> None:
        """Validate, and turn a negative amplitude into a positive one half a cycle on."""
        if self.duration == math.inf and self.slope != 0.0:
            raise ModelError(
                "slope",
                self.slope,
                "the acceleration of an endless segment may not grow for ever",
                "give the segment a finite duration",
            )
        if self.amplitude != 0.0 and self.frequency == 0.0:
            raise ModelError(
                "frequency",
                self.frequency,
                "a sinusoid needs a frequency above 0",
                "give omega/p, or put a constant acceleration into `constant`",
            )
        if self.harmonics != ():
            self._set_harmonics()
        elif self.amplitude < 0.0:
            object.__setattr__(self, "amplitude", -self.amplitude)
            # Towards 0, and with the digits of pi that a double leaves out: so the march's clock
            # reads the same phase one half cycle on, and what is turned round is a mirror image.
            turn = -1.0 if self.phase > 0.0 else 1.0
            object.__setattr__(self, "phase", (self.phase + turn * math.pi) + turn * PI_LOW)

    def _set_harmonics(self) -> None:
        """Validate the harmonics, and turn those of a negative amplitude round."""
        waves = harmonics_value(self.harmonics)
        if self.constant != 0.0 or self.slope != 0.0:
            raise ModelError(
                "harmonics",
                self.harmonics,
                "a Fourier series has no constant and no slope beside it",
                "leave these at 0",
            )
        if self.frequency == 0.0:
            raise ModelError(
                "frequency",
                self.frequency,
                "a Fourier series needs a frequency above 0",
                "give omega/p of its period",
            )
        if self.amplitude < 0.0:
            object.__setattr__(self, "amplitude", -self.amplitude)
            waves = tuple((order, -size, phase) for order, size, phase in waves)
        object.__setattr__(self, "harmonics", waves)


class Motion(Protocol):
    """What `rocksteady.simulate` needs of a base motion."""

    def segments(self) -> tuple[Segment, ...]:
        """Return the segments; after the last one the base stands still."""
        ...


def segments_of(motion: Motion) -> tuple[Segment, ...]:
    """Return the segments of a base motion of any class.

    Raises
    ------
    InputError
        If they are no segments.
    """
    given: object = motion.segments()
    if not isinstance(given, tuple | list) or not all(isinstance(p, Segment) for p in given):
        raise InputError(
            "motion",
            motion,
            "its segments() must return Segments",
            "return (rs.motions.Segment(...),)",
        )
    return tuple(given)


@checked
@dataclass(frozen=True, kw_only=True)
class Harmonic(DescribedMotion):
    """Endless harmonic shaking, base acceleration ``A sin(Omega s + phase)`` (eq 3).

    Parameters
    ----------
    amplitude
        A = a_max / (alpha g), from 0 to 1e50; 1 just lifts a block at rest.
    frequency_ratio
        Omega = omega / p, from 0.01 to 10 000.
    phase
        Phase at the start [rad].

    Raises
    ------
    InputError
        If a number is outside its range.

    Examples
    --------
    >>> Harmonic(amplitude=2.0, frequency_ratio=4.0)
    Harmonic(amplitude=2.0, frequency_ratio=4.0, phase=0.0)
    """

    amplitude: Annotated[float, AMPLITUDE]
    frequency_ratio: Annotated[float, FREQUENCY_RATIO]
    phase: Annotated[float, PHASE] = 0.0

    @classmethod
    def from_si(
        cls, block: Block, *, acceleration_m_s2: float, frequency_hz: float, phase: float = 0.0
    ) -> "Harmonic":
        """Return the shaking of a given block in its own measures.

        Parameters
        ----------
        block
            The block that is shaken; its alpha, p and g set the scales.
        acceleration_m_s2
            Peak base acceleration [m/s^2].
        frequency_hz
            Frequency [Hz].
        phase
            Phase at the start [rad].

        Raises
        ------
        InputError
            If a number is outside its range.

        Examples
        --------
        >>> block = Block.from_p(alpha=0.2, p=6.283185307179586)
        >>> motion = Harmonic.from_si(block, acceleration_m_s2=3.92266, frequency_hz=4.0)
        >>> round(motion.amplitude, 12), round(motion.frequency_ratio, 12)
        (2.0, 4.0)
        """
        a = non_negative("acceleration_m_s2", acceleration_m_s2, hint="give the peak in m/s^2")
        f = positive("frequency_hz", frequency_hz, hint="give the frequency in Hz")
        ratio = 2.0 * math.pi * f / block.p
        if not LOWEST_FREQUENCY_RATIO <= ratio <= HIGHEST_FREQUENCY_RATIO:
            raise InputError(
                "frequency_hz",
                frequency_hz,
                f"for a block with p = {block.p:.6g} rad/s it must lie in "
                f"[{LOWEST_FREQUENCY_RATIO * block.p / (2.0 * math.pi):.6g}, "
                f"{HIGHEST_FREQUENCY_RATIO * block.p / (2.0 * math.pi):.6g}]",
                "give the frequency in Hz",
            )
        return cls(amplitude=a / block.uplift_acceleration, frequency_ratio=ratio, phase=phase)

    def acceleration_m_s2(self, block: Block) -> float:
        """Return the peak base acceleration for a block [m/s^2]."""
        return self.amplitude * block.uplift_acceleration

    def frequency_hz(self, block: Block) -> float:
        """Return the frequency for a block [Hz]."""
        return self.frequency_ratio * block.p / (2.0 * math.pi)

    def segments(self) -> tuple[Segment, ...]:
        """Return the one endless segment."""
        return (
            Segment(
                duration=math.inf,
                amplitude=self.amplitude,
                frequency=self.frequency_ratio,
                phase=self.phase,
            ),
        )


@checked
@dataclass(frozen=True, kw_only=True)
class Still(DescribedMotion):
    """A base that stands still: free rocking."""

    def segments(self) -> tuple[Segment, ...]:
        """Return no segment: all that follows is the still base."""
        return ()


@checked
@dataclass(frozen=True, kw_only=True)
class Piecewise(DescribedMotion):
    """A dimensionless base motion made of segments, followed by a still base.

    Parameters
    ----------
    pieces
        The segments in order; only the last may be endless.

    Raises
    ------
    ModelError
        If a segment follows an endless one.

    Examples
    --------
    A rectangular pulse of 1.5 alpha g that lasts ln 3 just topples a slender block [1]_.

    >>> pulse = Piecewise(pieces=(Segment(duration=1.0986, constant=1.5),))
    >>> len(pulse.segments())
    1

    References
    ----------
    .. [1] G. W. Housner, Bull. Seism. Soc. Am. 53, 403-417 (1963).
    """

    pieces: Annotated[tuple[Segment, ...], INSIDE] = field(default_factory=tuple)

    def __post_init__(self) -> None:
        """Validate."""
        given: object = self.pieces
        if not isinstance(given, tuple | list) or not all(isinstance(p, Segment) for p in given):
            raise InputError(
                "pieces",
                self.pieces,
                "it must be a sequence of Segments",
                "give pieces=(rs.motions.Segment(...),)",
            )
        object.__setattr__(self, "pieces", tuple(given))
        for piece in self.pieces[:-1]:
            if piece.duration == math.inf:
                raise ModelError(
                    "pieces",
                    piece,
                    "only the last segment may be endless",
                    "give the earlier ones a finite duration",
                )

    def segments(self) -> tuple[Segment, ...]:
        """Return the segments."""
        return self.pieces
