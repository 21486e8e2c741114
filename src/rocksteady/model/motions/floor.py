"""Floors of buildings: the motion of a floor by the linear modes of its building."""

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Annotated, Any, TypeVar

from rocksteady.errors import InputError, ModelError
from rocksteady.kernels.elementary.arrays import atan2, exp, hypot, log, sincos
from rocksteady.model.blocks.block import Block
from rocksteady.model.checks.arguments import checked
from rocksteady.model.checks.bounds import Bounds
from rocksteady.model.checks.validation import LARGEST
from rocksteady.model.motions._sampled import polyline
from rocksteady.model.motions.base_motion import BaseMotion
from rocksteady.model.motions.fourier import FourierSeries
from rocksteady.model.motions.oscillator import (
    DEFAULT_DAMPING,
    Parts,
    grown,
    imaginary,
    inverse,
    rate_of,
    states,
    steady_line,
)
from rocksteady.model.motions.record import Record
from rocksteady.model.motions.segments import Harmonic, Motion, Piecewise, Segment, segments_of

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

    from rocksteady.arrays import Floats

MODE_HZ = Bounds(1e-3, 1e4, "[]", "give the natural frequency of a mode in Hz, 1/T")
DAMPING = Bounds(0.0, 1.0, "()", "give it over the critical one, as 0.05")
SHAPE = Bounds(
    -5.0, 5.0, "[]", "give participation factor times mode shape at the floor, as 1.3 at a roof"
)
TOLERANCE = Bounds(1e-9, 0.1, "[]", "give a share of the peak ground acceleration, as 0.001")
MOST_MODES = 50
LEAST_SUM, LARGEST_SUM = 0.0, 2.5
"""Of the shapes of a floor, which is 1 with all modes of its building."""
MOST_SAMPLES = 5_000_000
"""Of the record of a floor."""

DEFAULT_TOLERANCE = 1e-3

AnyMotion = TypeVar(
    "AnyMotion", Record, BaseMotion, Record | BaseMotion, Harmonic, FourierSeries, Motion
)


@checked
@dataclass(frozen=True, kw_only=True)
class Floor:
    """A floor that moves with the linear modes of its building.

    With mode j at rest at first, ``x_j'' + 2 zeta_j w_j x_j' + w_j^2 x_j = -a_g``, and the
    acceleration of the floor is ``a_g + sum_j s_j x_j''`` [1]_.  What the shapes s_j leave of 1
    moves with the ground.

    Parameters
    ----------
    frequencies_hz
        Natural frequency of each mode [Hz], or of the one mode.
    damping
        zeta of each mode, or of all, inside (0, 1).
    shapes
        s_j, participation factor times mode shape at the floor, of each mode; 1 of a single mode
        by default.  Of all modes together they add up to 1.

    Raises
    ------
    InputError
        If there is no mode, a number is outside its range, there is not one number for each mode,
        or the shapes add up to less than 0 or more than 2.5.

    References
    ----------
    .. [1] A. K. Chopra, Dynamics of Structures, 4th edition, Prentice Hall, 2012, chapter 13.

    Examples
    --------
    >>> floor = Floor(frequencies_hz=1.5, damping=0.05)
    >>> print(f"{floor.amplification(1.5):.6f}")
    10.049876
    """

    frequencies_hz: Sequence[float] | float
    damping: Sequence[float] | float = DEFAULT_DAMPING
    shapes: Sequence[float] | float = 1.0

    def __post_init__(self) -> None:
        """Validate, and turn single numbers into tuples of one for each mode."""
        rules = {"frequencies_hz": MODE_HZ, "damping": DAMPING, "shapes": SHAPE}
        given = {name: _numbers(name, getattr(self, name), rule) for name, rule in rules.items()}
        count = len(given["frequencies_hz"])
        if not 1 <= count <= MOST_MODES:
            raise InputError(
                "frequencies_hz",
                self.frequencies_hz,
                f"a floor has 1 to {MOST_MODES} modes",
                "give the frequencies of the lowest modes",
            )
        if len(given["damping"]) == 1:
            given["damping"] *= count
        for name, values in given.items():
            if len(values) != count:
                valid = f"there must be one for each of {count} modes"
                raise InputError(name, getattr(self, name), valid, "give as many as frequencies")
            object.__setattr__(self, name, values)
        total = math.fsum(given["shapes"])
        if not LEAST_SUM <= total <= LARGEST_SUM:
            raise InputError(
                "shapes",
                given["shapes"],
                f"they add up to {total:.4g}, and those of all modes of a building to 1; a few "
                f"modes give {LEAST_SUM:g} to {LARGEST_SUM:g}",
                "give participation factor times mode shape, with their signs",
            )

    @property
    def label(self) -> str:
        """The modes in words, as "floor of 1.5 Hz, damping 5 %, shape 1.3"."""
        hertz, damping, shapes = zip(*self.modes, strict=True)
        kept = damping[:1] if len(set(damping)) == 1 else damping
        words = [", ".join(f"{each:.4g}" for each in values) for values in (hertz, shapes)]
        zetas = ", ".join(f"{100.0 * zeta:.4g}" for zeta in kept)
        return f"floor of {words[0]} Hz, damping {zetas} %, shape {words[1]}"

    @property
    def modes(self) -> tuple[tuple[float, float, float], ...]:
        """Frequency [Hz], damping and shape of each mode."""
        rows = zip(self.frequencies_hz, self.damping, self.shapes, strict=True)  # type: ignore[arg-type]
        return tuple(rows)

    def amplification(self, frequency_hz: "ArrayLike") -> "Floats":
        """Return the amplitude of the floor over the ground's under lasting harmonic shaking.

        Parameters
        ----------
        frequency_hz
            Frequencies of the shaking [Hz], 1e-50 to 1e50, any shape.

        Raises
        ------
        InputError
            If one is none of these.
        """
        sine, cosine = self._shares(frequency_hz)
        return hypot(sine, cosine)

    def phase_lead(self, frequency_hz: "ArrayLike") -> "Floats":
        """Return by how much the floor's phase is ahead of the ground's then, (-pi, pi] [rad].

        Parameters and errors are those of `amplification`.
        """
        sine, cosine = self._shares(frequency_hz)
        return atan2(cosine, sine)

    def _shares(self, frequency_hz: "ArrayLike") -> "tuple[Floats, Floats]":
        """Return the sine's and the cosine's share of the floor under a lasting sine of size 1."""
        import numpy as np

        given = np.asarray(frequency_hz, dtype=np.float64)
        if not ((given >= 1.0 / LARGEST) & (given <= LARGEST)).all():
            valid = f"all must lie in [{1.0 / LARGEST:g}, {LARGEST:g}]"
            raise InputError("frequency_hz", frequency_hz, valid, "give frequencies in Hz")
        sine, cosine = self._modes_at(1.0).shares(2.0 * math.pi * given)
        return np.asarray(sine), np.asarray(cosine) + np.zeros_like(given)

    def motion(
        self, motion: AnyMotion, block: Block | None = None, *, tolerance: float = DEFAULT_TOLERANCE
    ) -> AnyMotion:
        """Return the motion of the floor; as `floor_motion`, which documents it.

        Raises
        ------
        InputError, ModelError
            As `floor_motion`.
        """
        return self._moved(motion, block, tolerance)  # type: ignore[no-any-return]

    @checked
    def _moved(
        self,
        motion: Motion | Record | BaseMotion,
        block: Block | None,
        tolerance: Annotated[float, TOLERANCE],
    ) -> Any:
        """Return the motion of the floor."""
        if isinstance(motion, BaseMotion):
            return replace(motion, horizontal=self._moved(motion.horizontal, block, tolerance))
        if isinstance(motion, Record):
            return self._recorded(motion, tolerance)
        if not isinstance(block, Block):
            raise ModelError(
                "block",
                block,
                "a motion in a block's own measures has no hertz without a block of known size",
                "give the Block that stands on the floor",
            )
        modes = self._modes_at(block.p)
        if isinstance(motion, Harmonic):
            size, _, phase = modes.turned(motion.amplitude, motion.frequency_ratio, motion.phase)
            return replace(motion, amplitude=size, phase=_rounded(phase))
        if isinstance(motion, FourierSeries):
            harmonics = []
            for order, *wave in motion.harmonics:
                size, _, phase = modes.turned(wave[0], order * motion.frequency_ratio, wave[1])
                harmonics.append((order, size, _rounded(phase)))
            return replace(motion, harmonics=tuple(harmonics))
        return Piecewise(pieces=modes.response(segments_of(motion), tolerance))

    def _modes_at(self, p: float) -> "_Modes":
        """Return the modes in units of a block's p."""
        rates = [rate_of(2.0 * math.pi * hertz / p, zeta) for hertz, zeta, _ in self.modes]
        return _Modes(rates, [shape for _, _, shape in self.modes])

    def _recorded(self, ground: Record, tolerance: float) -> Record:
        """Return the record of the floor, at a whole part of the interval of the ground's."""
        import numpy as np

        modes = self._modes_at(1.0)
        a, dt = ground.acceleration_m_s2, ground.dt_s
        error = tolerance * ground.peak_acceleration_m_s2
        slope = np.diff(a) / dt
        swings, left, curved = [], [], np.zeros(len(slope))
        for rate, power in zip(modes.rates, modes.powers, strict=True):
            z = states(a, dt, rate)
            inside = Parts(z.real[:-1], z.imag[:-1]) - steady_line(a[:-1], slope, rate)
            swings.append(power * inside)
            left.append(power * Parts(float(z.real[-1]), float(z.imag[-1])))
            curved = curved + _square(rate) * hypot(*swings[-1])
        after = modes.quiet_after(left, error)
        curvature = max(float(curved.max()), modes.curvature(left))
        least = dt * math.sqrt(curvature / (8.0 * error))
        parts = max(1, math.ceil(min(least, MOST_SAMPLES + 1.0)))
        count = len(slope) + after / dt
        if count * parts > MOST_SAMPLES:
            raise InputError(
                "tolerance",
                tolerance,
                f"the floor's record would have {count * parts:.3g} samples, and "
                f"{MOST_SAMPLES:,} are the most",
                "give a larger one, or more damping",
            )
        within = np.arange(parts) * (dt / parts)
        values = a[:-1, np.newaxis] + slope[:, np.newaxis] * within
        free = np.arange(math.ceil(after / dt) * parts + 1) * (dt / parts)
        tail = np.zeros(len(free))
        tail[0] = (1.0 - modes.total) * a[-1]
        for rate, swing, last in zip(modes.rates, swings, left, strict=True):
            grows = grown(rate, within)
            values = values + imaginary(
                Parts(swing.real[:, np.newaxis], swing.imag[:, np.newaxis]), grows
            )
            tail = tail + imaginary(last, grown(rate, free))
        samples = np.append(values.ravel(), tail)
        lowest = f"floor {min(self.modes)[0]:.3g} Hz"
        return Record(
            acceleration_m_s2=samples,
            dt_s=dt / parts,
            name=None if ground.name is None else f"{ground.name} ({lowest})",
            ground=ground.reference,
        )


@checked
def floor_motion(
    motion: AnyMotion,
    *,
    frequencies_hz: Sequence[float] | float,
    damping: Sequence[float] | float = DEFAULT_DAMPING,
    shapes: Sequence[float] | float = 1.0,
    block: Block | None = None,
    tolerance: float = DEFAULT_TOLERANCE,
) -> AnyMotion:
    """Return the motion of a floor of a building on a base that moves.

    The response of each mode is exact for the ground that is given: lines of a record, constants,
    lines, sinusoids and impulses of other motions.  Straight lines then follow the sum within the
    tolerance.  A record rings on until the floor is quiet to within the tolerance; where it ends
    away from 0, the floor falls to its free swing within one step.  Endless harmonic and periodic
    shaking gives the shaking of the floor once its transient has died away, without lines.

    Parameters
    ----------
    motion
        Motion of the ground.  Of a `BaseMotion` the vertical component stays that of the ground.
    frequencies_hz, damping, shapes
        Modes of the building, as in `rocksteady.motions.Floor`.
    block
        Block on the floor, which gives the units of a motion that is no record.
    tolerance
        Largest error of the floor's acceleration over the peak acceleration of the ground.

    Returns
    -------
    Record, BaseMotion or Motion
        A `Record` of a `Record`, which keeps the ground's as `ground`: levels of an ensemble are
        measured there.  A `Harmonic` of a `Harmonic`, a `FourierSeries` of a `FourierSeries`, and
        a `Piecewise` of any other motion.

    Raises
    ------
    InputError
        As for `rocksteady.motions.Floor`; and if the tolerance needs too many lines.
    ModelError
        If a motion that is no record has no block.

    Examples
    --------
    >>> from rocksteady import Record, floor_motion
    >>> ground = Record(acceleration_m_s2=[0.0, 2.0, -2.0, 0.0], dt_s=0.25)
    >>> floor = floor_motion(ground, frequencies_hz=2.0, shapes=1.3)
    >>> print(f"{floor.peak_acceleration_m_s2:.2f} m/s^2 on {ground.peak_acceleration_m_s2:.2f}")
    5.90 m/s^2 on 2.00
    """
    floor = Floor(frequencies_hz=frequencies_hz, damping=damping, shapes=shapes)
    return floor.motion(motion, block, tolerance=tolerance)


class _Modes:
    """Modes in the unit of time of a motion.

    Attributes
    ----------
    rates
        L of each.
    powers
        s L^2/wd of each: the imaginary part of it times z is what the mode adds to the floor.
    total
        Sum of the shapes.
    """

    def __init__(self, rates: Sequence[Parts], shapes: Sequence[float]) -> None:
        self.rates = rates
        self.powers = [
            rate * rate * Parts(shape, 0.0) / rate.imag
            for rate, shape in zip(rates, shapes, strict=True)
        ]
        self.total = math.fsum(shapes)

    def shares(self, frequency: Any) -> tuple[Any, Any]:
        """Return the sine's and the cosine's share of the floor under a lasting sine of size 1."""
        sine, cosine = 1.0 - self.total, 0.0
        for rate, power in zip(self.rates, self.powers, strict=True):
            of_sine, of_cosine = _lasting(rate, frequency)
            sine, cosine = sine + imaginary(power, of_sine), cosine + imaginary(power, of_cosine)
        return sine, cosine

    def turned(self, size: float, frequency: float, phase: float) -> tuple[float, float, float]:
        """Return size, frequency and phase of the floor under a lasting sine."""
        sine, cosine = self.shares(frequency)
        return size * hypot(sine, cosine), frequency, phase + atan2(cosine, sine)

    def quiet_after(self, swings: Sequence[Parts], error: float) -> float:
        """Return the time after which free swings are together below an error."""
        return max(
            max(0.0, log(hypot(*swing) * len(swings) / error)) / -rate.real
            if hypot(*swing) > 0.0
            else 0.0
            for rate, swing in zip(self.rates, swings, strict=True)
        )

    def curvature(self, swings: Sequence[Parts]) -> float:
        """Return an upper bound of the second derivative of free swings."""
        return math.fsum(
            _square(rate) * hypot(*swing) for rate, swing in zip(self.rates, swings, strict=True)
        )

    def response(self, pieces: Sequence[Segment], tolerance: float) -> tuple[Segment, ...]:
        """Return the segments of the floor, from rest, within a share of the largest of the ground.

        Each mode is the response that lasts, in closed form, and a free swing that decays.
        """
        largest = max(map(_largest, pieces), default=0.0)
        jumps = [
            abs(piece.jump) * math.sqrt(_square(rate)) for piece in pieces for rate in self.rates
        ]
        error = tolerance * max(largest, *jumps, 0.0)
        if error == 0.0:
            return tuple(pieces)
        if not pieces or pieces[-1].duration != math.inf:
            pieces = (*pieces, Segment(duration=math.inf))
        z = [Parts(0.0, 0.0) for _ in self.rates]
        made: list[Segment] = []
        for piece in pieces:
            waves, jump = _waves(piece), Parts(piece.jump, 0.0)
            swings = [
                each - jump - _lasting_at(rate, piece, waves, 0.0)
                for each, rate in zip(z, self.rates, strict=True)
            ]
            made += self._lines(piece, waves, swings, error)
            if piece.duration < math.inf:
                z = [
                    swing * grown(rate, piece.duration)
                    + _lasting_at(rate, piece, waves, piece.duration)
                    for swing, rate in zip(swings, self.rates, strict=True)
                ]
        return tuple(made)

    def _lines(
        self,
        piece: Segment,
        waves: Sequence[tuple[float, float, float]],
        swings: Sequence[Parts],
        error: float,
    ) -> list[Segment]:
        """Return the floor during one segment of the ground: lines, then what lasts for ever."""
        import numpy as np

        turned = [self.turned(*wave) for wave in waves]
        scaled = [power * swing for power, swing in zip(self.powers, swings, strict=True)]
        endless = piece.duration == math.inf
        span = self.quiet_after(scaled, error) if endless else piece.duration

        def acceleration(s: "Floats") -> "Floats":
            total = np.asarray(piece.constant + piece.slope * s)
            for size, frequency, phase in turned:
                total = total + size * sincos(frequency * s + phase)[0]
            for rate, swing in zip(self.rates, scaled, strict=True):
                total = total + imaginary(swing, grown(rate, s))
            return total

        lasting = math.fsum(abs(size) * frequency * frequency for size, frequency, _ in turned)
        parts: list[tuple[float, float]] = []
        count = math.ceil(span * min(-rate.real for rate in self.rates))  # as swings decay
        for place in range(count):
            since = span * place / count
            decayed = [
                Parts(*(exp(rate.real * since) * part for part in swing))
                for rate, swing in zip(self.rates, scaled, strict=True)
            ]
            parts.append((span / count, lasting + self.curvature(decayed)))
        lines = [*polyline(acceleration, parts, tolerance=error)]
        if endless:
            lines.append(_endless(piece, turned, span))
        jump = (1.0 - self.total) * piece.jump
        return [replace(lines[0], jump=jump), *lines[1:]]


def _endless(piece: Segment, turned: Sequence[tuple[float, float, float]], since: float) -> Segment:
    """Return what an endless segment of the ground leaves of the floor, from a time of it on."""
    if len(piece.harmonics) == 0:
        size, frequency, phase = turned[0] if turned else (0.0, 0.0, 0.0)
        phase = _rounded(phase + frequency * since)
        return replace(piece, amplitude=size, frequency=frequency, phase=phase, jump=0.0)
    harmonics = tuple(
        (order, size, _rounded(phase + frequency * since))
        for (order, _, _), (size, frequency, phase) in zip(piece.harmonics, turned, strict=True)
    )
    return replace(piece, amplitude=1.0, phase=0.0, harmonics=harmonics, jump=0.0)


def _waves(piece: Segment) -> list[tuple[float, float, float]]:
    """Return size, frequency and phase of each sinusoid of a segment."""
    return [
        (piece.amplitude * size, order * piece.frequency, order * piece.phase + phase)
        for order, size, phase in piece.harmonics or ((1, 1.0, 0.0),)
        if piece.amplitude * size != 0.0
    ]


def _lasting(rate: Parts, frequency: Any) -> tuple[Parts, Parts]:
    """Return z of the lasting response to a sine of size 1: what is times its sine and its cosine.

    ``z' = L z - sin(W s)`` has ``z = (L sin(W s) + W cos(W s))/(L^2 + W^2)``.
    """
    below = inverse(rate * rate + Parts(frequency * frequency, 0.0 * frequency))
    return rate * below, Parts(frequency * below.real, frequency * below.imag)


def _lasting_at(
    rate: Parts, piece: Segment, waves: Sequence[tuple[float, float, float]], s: float
) -> Parts:
    """Return z of the lasting response to a segment at a time after its start."""
    line = steady_line(piece.constant + piece.slope * s, piece.slope, rate)
    for size, frequency, phase in waves:
        of_sine, of_cosine = _lasting(rate, frequency)
        sine, cosine = sincos(_rounded(frequency * s + phase))
        line += Parts(
            size * (sine * of_sine.real + cosine * of_cosine.real),
            size * (sine * of_sine.imag + cosine * of_cosine.imag),
        )
    return line


def _rounded(phase: float) -> float:
    """Return a phase less whole periods."""
    return math.remainder(phase, 2.0 * math.pi)


def _numbers(name: str, value: object, rule: Bounds) -> tuple[float, ...]:
    """Return one number or several, each inside its range."""
    listed = value.tolist() if hasattr(value, "tolist") else value  # of an array
    given = listed if isinstance(listed, Sequence) and not isinstance(listed, str) else [listed]
    return tuple(rule(name, each) for each in given)


def _square(z: Parts) -> float:
    return float(z.real * z.real + z.imag * z.imag)


def _largest(piece: Segment) -> float:
    """Return an upper bound of the acceleration of a segment."""
    end = piece.constant if piece.slope == 0.0 else piece.constant + piece.slope * piece.duration
    return max(abs(piece.constant), abs(end)) + math.fsum(abs(each[0]) for each in _waves(piece))
