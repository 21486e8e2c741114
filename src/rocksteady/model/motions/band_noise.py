"""Stationary Gaussian noise of a frequency band, alone and on top of another base motion."""

import math
from dataclasses import dataclass, replace
from functools import cached_property, lru_cache, partial
from typing import TYPE_CHECKING, Annotated, overload

from rocksteady.errors import InputError, ModelError
from rocksteady.kernels.elementary.arrays import log, sincos
from rocksteady.model.blocks.block import Block
from rocksteady.model.checks.arguments import checked
from rocksteady.model.checks.bounds import LARGEST_SEED, Bounds, Whole
from rocksteady.model.checks.validation import non_negative, rising
from rocksteady.model.motions._sampled import MOST_LINES, straight_lines
from rocksteady.model.motions.base_motion import BaseMotion
from rocksteady.model.motions.combine import cut
from rocksteady.model.motions.described_motion import DescribedMotion
from rocksteady.model.motions.record import Record
from rocksteady.model.motions.segments import (
    DURATION_S,
    HIGHEST_FREQUENCY_RATIO,
    LONGEST_DURATION,
    LOWEST_FREQUENCY_RATIO,
    RMS,
    Harmonic,
    Motion,
    Piecewise,
    Segment,
    segments_of,
)

if TYPE_CHECKING:
    from rocksteady.arrays import Floats

SAMPLES_A_PERIOD = 20
"""Of the highest frequency: straight lines between them leave out 0.3 % of the rms of a wide band,
0.8 % of a narrow one."""

LONGER = 2
"""Period of the process over the duration, so that its end does not follow from its beginning."""

MOST_PRODUCTS = 10**9
"""Samples times sinusoids: some seconds."""

MOST_KEPT = 16
"""Realisations that are kept, because several levels of noise share one."""

BAND = partial(
    rising,
    low=LOWEST_FREQUENCY_RATIO,
    high=HIGHEST_FREQUENCY_RATIO,
    hint="give the lowest and the highest omega/p, as (1.0, 20.0)",
)

SAME_TIME = 1e-9
"""Part of a step by which a sample may miss a segment's start and still be there."""

FIELDS = ("duration", "constant", "slope", "amplitude", "frequency", "phase", "jump")
"""Of a segment, in the order of the columns of `with_lines`."""
DURATION, CONSTANT, SLOPE, AMPLITUDE, FREQUENCY, PHASE, JUMP = range(len(FIELDS))


@checked
@dataclass(frozen=True, kw_only=True)
class BandNoise(DescribedMotion):
    """Stationary Gaussian noise with a flat spectrum between two frequencies.

    The base acceleration is a sum of sinusoids of all frequencies ``2 pi k/(2 duration)`` of the
    band, whose amplitudes have Rayleigh's distribution and whose phases are uniform [1]_; between
    20 samples per period of the highest one it is straight.  The process is Gaussian and
    stationary: the realisations of a seed are numbered, and differ by chance alone.

    Parameters
    ----------
    rms
        Root mean square of the process over alpha g, from 0 to 1e50; that of one realisation
        scatters.
    band
        Lowest and highest omega/p, from 0.01 to 10 000.
    duration
        Pivot time p t, up to 1e6; the base stands still afterwards.
    seed
        Whole number, 0 or above.
    number
        Number of the realisation (default 0), keyed with the seed as ``SeedSequence(seed,
        spawn_key=(number,))``: it does not depend on which others are made, in what order.

    Raises
    ------
    InputError
        If a number is outside its range, the band is narrower than half a cycle in the duration, or
        there are more than 200 000 samples, or 1e9 samples times sinusoids.

    Examples
    --------
    >>> noise = BandNoise(rms=0.2, band=(1.0, 10.0), duration=60.0, seed=1)
    >>> len(noise.segments()), round(float(noise.samples.std()), 3)
    (1910, 0.196)

    References
    ----------
    .. [1] M. Shinozuka and C.-M. Jan, J. Sound Vib. 25, 111-128 (1972); S. O. Rice, Bell Syst.
       Tech. J. 23, 282-332 (1944), section 2.8.
    """

    rms: Annotated[float, RMS]
    band: Annotated[tuple[float, float], BAND]
    duration: Annotated[float, Bounds(0.0, LONGEST_DURATION, "(]", "give the pivot time p t")]
    seed: Annotated[int, Whole(0, LARGEST_SEED, "give a seed, as 1")]
    number: Annotated[int, Whole(0, 2**32 - 1, "give 0, 1, ...")] = 0

    def __post_init__(self) -> None:
        """Validate what depends on several fields."""
        lines = self._lines
        if lines > MOST_LINES:
            raise InputError(
                "duration",
                self.duration,
                f"it would take {lines:,} straight lines, and {MOST_LINES:,} are the most",
                f"give {self.duration * MOST_LINES / lines:.3g} or less, or a lower band",
            )
        first, last = self._bins
        if first > last:
            raise InputError(
                "band",
                self.band,
                f"it holds no sinusoid: in this duration they are {self._spacing:.3g} apart",
                "give a wider band or a longer duration",
            )
        if lines * (last - first + 1) > MOST_PRODUCTS:
            raise InputError(
                "duration",
                self.duration,
                f"{lines:,} samples of {last - first + 1:,} sinusoids are more than 1e9 products",
                "give a shorter duration or a narrower band",
            )

    @classmethod
    def from_si(
        cls,
        block: Block,
        *,
        rms_m_s2: Annotated[float, partial(non_negative, hint="give it in m/s^2")],
        band_hz: tuple[float, float],
        duration_s: Annotated[float, DURATION_S],
        seed: int,
        number: int = 0,
    ) -> "BandNoise":
        """Return noise in the measures of a given block.

        Parameters
        ----------
        block
            The block that is shaken.
        rms_m_s2
            Root mean square of the process [m/s^2].
        band_hz
            Lowest and highest frequency [Hz].
        duration_s
            Duration [s].
        seed, number
            As for `BandNoise`.

        Raises
        ------
        InputError
            If a number is outside its range.

        Examples
        --------
        >>> block = Block.rectangle(width=0.5, height=2.0)
        >>> noise = BandNoise.from_si(
        ...     block, rms_m_s2=0.3, band_hz=(0.5, 10.0), duration_s=20.0, seed=7
        ... )
        >>> round(noise.rms * block.uplift_acceleration, 12), round(noise.duration / block.p, 12)
        (0.3, 20.0)
        """
        low, high = (
            Harmonic.from_si(block, acceleration_m_s2=0.0, frequency_hz=hertz).frequency_ratio
            for hertz in band_hz
        )
        return cls(
            rms=rms_m_s2 / block.uplift_acceleration,
            band=(low, high),
            duration=duration_s * block.p,
            seed=seed,
            number=number,
        )

    def realisation(self, number: int, *, rms: float | None = None) -> "BandNoise":
        """Return another realisation of the same process.

        Parameters
        ----------
        number
            Number of the realisation.
        rms
            Root mean square in place of the process's own.

        Raises
        ------
        InputError
            If a number is outside its range.
        """
        return replace(self, number=number, rms=self.rms if rms is None else rms)

    @property
    def step(self) -> float:
        """Pivot time between two samples; a whole number of them makes the duration."""
        return self.duration / self._lines

    @property
    def samples(self) -> "Floats":
        """Base acceleration in units of alpha g, every `step`, from 0 to the duration."""
        first, last = self._bins
        unit = _process(self.seed, self.number, first, last, self._lines)
        scaled: Floats = self.rms * unit
        return scaled

    def segments(self) -> tuple[Segment, ...]:
        """Return straight lines between the samples; none of noise of rms 0."""
        return self._pieces

    @cached_property
    def _pieces(self) -> tuple[Segment, ...]:
        """The segments, made once."""
        return straight_lines(self.samples, self.step) if self.rms else ()

    @property
    def _lines(self) -> int:
        """Straight lines of a realisation."""
        return max(1, math.ceil(SAMPLES_A_PERIOD * self.band[1] * self.duration / (2.0 * math.pi)))

    @property
    def _spacing(self) -> float:
        """Distance of neighbouring sinusoids in omega/p."""
        return 2.0 * math.pi / (LONGER * self.duration)

    @property
    def _bins(self) -> tuple[int, int]:
        """The first and the last sinusoid of the band, in units of their distance."""
        low, high = self.band
        return math.ceil(low / self._spacing), math.floor(high / self._spacing)


@overload
def add_noise(
    motion: BaseMotion, noise: BandNoise, *, block: Block | None = None
) -> BaseMotion: ...
@overload
def add_noise(
    motion: Motion | Record, noise: BandNoise, *, block: Block | None = None
) -> Piecewise: ...
@checked
def add_noise(
    motion: "Motion | Record | BaseMotion", noise: BandNoise, *, block: Block | None = None
) -> "Piecewise | BaseMotion":
    """Add noise to a base motion, from the start of both on.

    The sum is exact: segments are cut at the samples of the noise, and its straight lines added to
    theirs.  Noise of rms 0 leaves the motion as it is, segment by segment.

    Parameters
    ----------
    motion
        Any base motion; for a `BaseMotion` the horizontal component.  An endless one ends with the
        noise; of others, noise and motion each last as long as they do.
    noise
        The noise.
    block
        The block that is shaken, in whose measures a `Record` is put; needed for that alone.

    Returns
    -------
    Piecewise or BaseMotion
        In units of alpha g and pivot time.

    Raises
    ------
    ModelError
        If a record comes without a block.
    InputError
        If a phase is beyond 1e6.

    Examples
    --------
    >>> from rocksteady import Harmonic
    >>> from rocksteady.motions import BandNoise, add_noise
    >>> noise = BandNoise(rms=0.1, band=(1.0, 10.0), duration=20.0, seed=1)
    >>> noisy = add_noise(Harmonic(amplitude=2.0, frequency_ratio=4.0), noise)
    >>> len(noisy.pieces), noisy.pieces[0].amplitude, noisy.pieces[0].frequency
    (637, 2.0, 4.0)
    """
    if isinstance(motion, BaseMotion):
        return replace(motion, horizontal=add_noise(motion.horizontal, noise, block=block))
    if isinstance(motion, Record):
        if block is None:
            raise ModelError(
                "motion",
                motion,
                "a record in seconds and m/s^2 needs the block in whose measures noise is added",
                "give block=, or add noise to the samples",
            )
        values = motion.acceleration_m_s2 / block.uplift_acceleration
        pieces = straight_lines(values, motion.dt_s * block.p)
    else:
        pieces = segments_of(finite(motion, noise))
    if not noise.rms:
        return Piecewise(pieces=pieces)
    import numpy as np

    rows = np.array([[getattr(piece, name) for name in FIELDS] for piece in pieces])
    rows = rows.reshape(len(pieces), len(FIELDS))
    if not len(pieces) or pieces[-1].duration != math.inf:
        rows = np.concatenate([rows, _still()])
    summed = with_lines(rows, noise.samples, noise.step)
    if not summed[-1, JUMP]:
        summed = summed[:-1]
    return Piecewise(
        pieces=tuple(Segment(**dict(zip(FIELDS, row, strict=True))) for row in summed.tolist())
    )


def finite(motion: Motion, noise: BandNoise) -> Motion:
    """Return a motion that ends: an endless one is cut off where the noise ends."""
    pieces = segments_of(motion)
    last = pieces[-1] if pieces else None
    still = last is None or (last.constant == 0.0 and last.amplitude == 0.0)
    if last is None or last.duration != math.inf or (still and not last.frequency):
        return motion
    return cut(motion, noise.duration)


def with_lines(rows: "Floats", values: "Floats", step: float) -> "Floats":
    """Return a motion with straight lines between evenly spaced values added to it.

    Parameters
    ----------
    rows
        Segments of the motion, shape (segments, 7), columns as `FIELDS`; the last one is endless
        and still, except for an impulse at its start.
    values
        In units of alpha g, from time 0 on, shape (lines + 1,).
    step
        Pivot time between two of them.

    Returns
    -------
    ndarray
        Segments of the sum, of the same form.
    """
    import numpy as np

    if not values.any():
        return rows
    starts = np.concatenate([[0.0], np.cumsum(rows[:-1, DURATION])])
    knots = step * np.arange(len(values))
    # A sample that rounding puts beside a start is at the start.
    after = np.searchsorted(starts, knots)
    later, earlier = starts[np.minimum(after, len(starts) - 1)], starts[np.maximum(after - 1, 0)]
    nearest = np.where(np.abs(later - knots) < np.abs(knots - earlier), later, earlier)
    knots = np.where(np.abs(nearest - knots) <= SAME_TIME * step, nearest, knots)
    cuts = np.union1d(starts, knots)
    index = np.searchsorted(starts, cuts, side="right") - 1
    line = np.searchsorted(knots, cuts, side="right") - 1
    since = cuts - starts[index]
    segments: Floats = rows[index].copy()
    ends = np.append(cuts[1:], math.inf)
    lasting = np.append(np.diff(cuts), math.inf)
    following = np.append(knots, math.inf)
    whole = (cuts == knots[line]) & (ends == following[line + 1])
    lasting = np.where(whole & np.isfinite(ends), step, lasting)
    whole = (since == 0.0) & (ends == np.append(starts, math.inf)[index + 1])
    segments[:, DURATION] = np.where(whole, segments[:, DURATION], lasting)
    segments[:, CONSTANT] += segments[:, SLOPE] * since
    segments[:, PHASE] += segments[:, FREQUENCY] * since
    segments[:, JUMP] = np.where(since == 0.0, segments[:, JUMP], 0.0)
    lines = len(values) - 1
    rise = (values[1:] - values[:-1]) / step
    under = line < lines
    on = np.minimum(line, lines - 1)
    segments[:, CONSTANT] += np.where(under, values[on] + rise[on] * (cuts - knots[on]), 0.0)
    segments[:, SLOPE] += np.where(under, rise[on], 0.0)
    segments[segments[:, AMPLITUDE] == 0.0, FREQUENCY : PHASE + 1] = 0.0
    return segments


def _still() -> "Floats":
    """Return a still base without end as a segment."""
    import numpy as np

    row = np.zeros((1, len(FIELDS)))
    row[0, DURATION] = math.inf
    return row


@lru_cache(maxsize=MOST_KEPT)
def _process(seed: int, number: int, first: int, last: int, lines: int) -> "Floats":
    """Return a realisation of rms 1, the same to the last bit on every machine.

    Sinusoid k is ``cos(2 pi k j/(2 lines) - phase)`` at sample j.  All of their values are those of
    one turn, of which every k picks its own.
    """
    import numpy as np

    count = last - first + 1
    words = np.random.PCG64(np.random.SeedSequence(seed, spawn_key=(number,)))
    drawn = np.random.Generator(words).random((count, 2))
    size = np.sqrt(-2.0 * np.asarray(log(1.0 - drawn[:, 0])) / count)
    sine, cosine = sincos(2.0 * math.pi * drawn[:, 1])
    period = LONGER * lines
    waves, others = sincos(2.0 * math.pi / period * np.arange(period))
    total = np.zeros(lines + 1)
    place = np.arange(lines + 1)
    for k, sines, cosines in zip(range(first, last + 1), size * sine, size * cosine, strict=True):
        at = place * k % period
        total += cosines * others[at] + sines * waves[at]
    total.flags.writeable = False
    return total
