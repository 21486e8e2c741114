"""Synthetic ground motion: seeded noise with the spectrum and the envelope of an earthquake."""

import math
from dataclasses import dataclass
from functools import cached_property, partial
from typing import TYPE_CHECKING, Annotated

from rocksteady.errors import InputError
from rocksteady.kernels.elementary.arrays import exp, log
from rocksteady.model.blocks.block import Block
from rocksteady.model.checks.arguments import checked
from rocksteady.model.checks.bounds import Bounds, Whole
from rocksteady.model.checks.validation import non_negative
from rocksteady.model.motions._sampled import MOST_LINES, straight_lines
from rocksteady.model.motions.described_motion import DescribedMotion
from rocksteady.model.motions.segments import (
    DURATION_S,
    FREQUENCY_RATIO,
    LONGEST_DURATION,
    RMS,
    Harmonic,
    Segment,
)

if TYPE_CHECKING:
    from rocksteady.arrays import Floats

SAMPLES_A_PERIOD = 40
"""Of the ground; the spectrum then reaches to 20 times its frequency."""

LEFT_AT_THE_END = 0.01
"""Of the envelope's strong part."""

DAMPING = Bounds(0.01, 1.0, "[]", "give it over the critical one, as 0.6")
"""Below it the filters take too long to forget how they began."""

SETTLED = 10.0
"""Time constants after which a filter has forgotten how it began."""

MOST_SETTLING = 10_000_000
"""Samples for that: a second."""


@checked
@dataclass(frozen=True, kw_only=True)
class SyntheticMotion(DescribedMotion):
    """Artificial ground motion: filtered white noise under an envelope.

    White noise passes the ground filter of Kanai and Tajimi and the high-pass of Clough and
    Penzien [1]_, whose spectral density is, with x the frequency over that of the ground and h the
    high-pass ratio::

        S(x) ~ (1 + (2 damping x)^2) / ((1 - x^2)^2 + (2 damping x)^2)
               * x^4 / ((h^2 - x^2)^2 + (2 damping h x)^2)

    The envelope of Amin and Ang [2]_ rises with the square of time, stays at 1 and decays
    exponentially to a hundredth.  What is left of the mean is taken away in proportion to the
    envelope, so that the base ends with velocity 0.  Between its samples, 40 for each period of the
    ground, the motion is straight.

    Parameters
    ----------
    rms
        Root mean square of the base acceleration over alpha g, of the process while the envelope is
        1.  The largest acceleration is a matter of chance, usually 2.5 to 3.5 times as much.
    frequency_ratio
        Frequency of the ground, omega_g/p, from 0.01 to 10 000.
    duration
        Pivot time p t, up to 200 000 samples and 1e6.  A motion much shorter than a sample, a 40th
        of the ground's period, is refused.
    seed
        A whole number of 0 or above for `numpy.random.SeedSequence`: the same one gives the same
        motion, to the last bit, in one version of NumPy and SciPy.
    filter_damping
        Damping of both filters, from 0.01 to 1, 1 being critical; default 0.6, firm ground.
    high_pass_ratio
        Frequency of the high-pass over that of the ground, above 0 and below 1.
    rise, decay
        Parts of the duration in which the envelope rises and decays; together at most 1.

    Raises
    ------
    InputError
        If a number is outside its range, or the duration has more than 200 000 samples.

    Examples
    --------
    >>> motion = SyntheticMotion(rms=0.5, frequency_ratio=6.0, duration=30.0, seed=1)
    >>> len(motion.segments()), round(float(abs(motion.samples).max()), 3)
    (1146, 1.757)

    References
    ----------
    .. [1] R. W. Clough and J. Penzien, Dynamics of Structures, McGraw-Hill (1975); K. Kanai, Bull.
       Earthquake Res. Inst. Tokyo 35, 309-325 (1957); H. Tajimi, Proc. 2nd World Conf. Earthquake
       Eng. 2, 781-798 (1960).
    .. [2] M. Amin and A. H.-S. Ang, J. Eng. Mech. Div. ASCE 94, 559-583 (1968).
    """

    rms: Annotated[float, RMS]
    frequency_ratio: Annotated[float, FREQUENCY_RATIO]
    duration: float
    seed: Annotated[int, Whole(0, None, "give a seed, as 1")]
    filter_damping: Annotated[float, DAMPING] = 0.6
    high_pass_ratio: Annotated[float, Bounds(0.001, 1.0, "[)", "give 0.1")] = 0.1
    rise: Annotated[float, Bounds(0.0, 1.0, "[]", "give a part, as 0.15")] = 0.15
    decay: float = 0.5

    def __post_init__(self) -> None:
        """Validate what depends on other fields."""
        longest = min(LONGEST_DURATION, MOST_LINES * _sampling(self.frequency_ratio))
        for name, rule in (
            ("duration", Bounds(0.0, longest, "(]", "give the pivot time p t")),
            ("decay", Bounds(0.0, 1.0 - self.rise, "[]", "give a part, as 0.5")),
        ):
            object.__setattr__(self, name, rule(name, getattr(self, name)))
        if self._settling > MOST_SETTLING:
            shortest = self.duration * (self._settling / MOST_SETTLING)
            raise InputError(
                "duration",
                self.duration,
                f"at its step the filters would take {self._settling:.3g} samples to settle, "
                f"and {MOST_SETTLING:.0e} are the most",
                f"give {shortest:.3g} or more",
            )

    @classmethod
    def from_si(
        cls,
        block: Block,
        *,
        rms_m_s2: Annotated[float, partial(non_negative, hint="give it in m/s^2")],
        frequency_hz: float,
        duration_s: Annotated[float, DURATION_S],
        seed: int,
        filter_damping: float = 0.6,
    ) -> "SyntheticMotion":
        """Return a synthetic ground motion in the measures of a given block.

        Parameters
        ----------
        block
            The block that is shaken.
        rms_m_s2
            Root mean square of the strong part [m/s^2].
        frequency_hz
            Frequency of the ground [Hz]; 2.5 is firm ground (15.6 rad/s).
        duration_s
            Duration [s].
        seed, filter_damping
            As for `SyntheticMotion`.

        Raises
        ------
        InputError
            If a number is outside its range.

        Examples
        --------
        >>> block = Block.rectangle(width=0.5, height=2.0)
        >>> motion = SyntheticMotion.from_si(
        ...     block, rms_m_s2=1.0, frequency_hz=2.5, duration_s=20.0, seed=7
        ... )
        >>> round(motion.duration / block.p, 12)
        20.0
        """
        felt = Harmonic.from_si(block, acceleration_m_s2=rms_m_s2, frequency_hz=frequency_hz)
        return cls(
            rms=felt.amplitude,
            frequency_ratio=felt.frequency_ratio,
            duration=duration_s * block.p,
            seed=seed,
            filter_damping=filter_damping,
        )

    @property
    def step(self) -> float:
        """Pivot time between two samples; a whole number of them makes the duration."""
        return self.duration / max(1, round(self.duration / _sampling(self.frequency_ratio)))

    @property
    def _settling(self) -> float:
        """Samples in which the filters forget how they began; for a short motion they are short."""
        slowest = self.filter_damping * self.high_pass_ratio * self.frequency_ratio
        return SETTLED / (slowest * self.step) if self.step > 1e-300 else math.inf

    @cached_property
    def samples(self) -> "Floats":
        """Base acceleration in units of alpha g, every `step`, from 0 to the duration."""
        import numpy as np
        from scipy import signal

        filters = self._filters()
        settling = math.ceil(self._settling)
        response = signal.sosfilt(filters, np.eye(1, settling)[0])
        count = round(self.duration / self.step) + 1
        draw = np.random.default_rng(np.random.SeedSequence(self.seed))
        noise = draw.standard_normal(settling + count)
        process = signal.sosfilt(filters, noise)[settling:]
        envelope = self._envelope(np.linspace(0.0, 1.0, count))
        # Noise of variance 1 becomes a process whose variance is the response's sum of squares.
        motion = self.rms / math.sqrt(float(np.square(response).sum())) * process * envelope
        motion -= envelope * (np.trapezoid(motion) / np.trapezoid(envelope))
        return np.asarray(motion, dtype=np.float64)

    def segments(self) -> tuple[Segment, ...]:
        """Return straight lines between the samples."""
        return self._pieces

    @cached_property
    def _pieces(self) -> tuple[Segment, ...]:
        """The segments, made once."""
        return straight_lines(self.samples, self.step)

    def _filters(self) -> "Floats":
        """Return the two filters in discrete time, as second-order sections."""
        import numpy as np
        from scipy import signal

        ground, damping = self.frequency_ratio, self.filter_damping
        high = self.high_pass_ratio * ground
        # (2 d g s + g^2)/(s^2 + 2 d g s + g^2) of Kanai and Tajimi, s^2/(s^2 + 2 d h s + h^2)
        zeros = np.array([-ground / (2.0 * damping), 0.0, 0.0])
        turn = damping + 1j * math.sqrt(1.0 - damping * damping)
        poles = -np.array([ground * turn, ground / turn, high * turn, high / turn])
        discrete = signal.bilinear_zpk(zeros, poles, 2.0 * damping * ground, 1.0 / self.step)
        return np.asarray(signal.zpk2sos(*discrete), dtype=np.float64)

    def _envelope(self, time: "Floats") -> "Floats":
        """Return the envelope at parts of the duration."""
        import numpy as np

        part = time / self.rise if self.rise > 0.0 else np.ones(len(time))
        rising = np.minimum(1.0, part * part)
        late = np.maximum(0.0, time - (1.0 - self.decay)) / (self.decay or 1.0)
        return np.asarray(rising * exp(late * log(LEFT_AT_THE_END)))


def _sampling(frequency_ratio: float) -> float:
    """Return the pivot time between two samples, before a whole number of them fits."""
    return 2.0 * math.pi / (SAMPLES_A_PERIOD * frequency_ratio)
