"""Impulses: sudden changes of the velocity of the base."""

import math
from dataclasses import dataclass

from rocksteady.errors import InputError
from rocksteady.model.blocks.block import Block
from rocksteady.model.checks.arguments import checked
from rocksteady.model.checks.bounds import Bounds
from rocksteady.model.checks.validation import LARGEST, finite, in_range
from rocksteady.model.motions.described_motion import DescribedMotion
from rocksteady.model.motions.segments import LONGEST_DURATION, Segment


@checked
@dataclass(frozen=True, kw_only=True)
class Impulses(DescribedMotion):
    """Sudden changes of base velocity, which is constant between them.

    An impulse of the base changes the velocity of a block, d(theta/alpha)/ds, at once and by the
    same number: it is the integral of a(s), in units of alpha g, over an instant of s = p t.  One
    of size 1 just overturns a slender block at rest.

    Parameters
    ----------
    velocities
        Changes of the base velocity in units of alpha g/p; positive ones drive positive rotation.
    times
        Pivot times p t, 0 or later and each after the one before; 0 of a single impulse without.

    Raises
    ------
    InputError
        If the two differ in number, a number is outside its range, or a time is not after the one
        before.

    Examples
    --------
    >>> from rocksteady import DimensionlessBlock, simulate
    >>> block = DimensionlessBlock(restitution=0.9)
    >>> for size in (0.999, 1.001):
    ...     print(simulate(block, Impulses(velocities=(size,))).status.label)
    at-rest
    overturned
    """

    velocities: tuple[float, ...]
    times: tuple[float, ...] = (0.0,)

    def __post_init__(self) -> None:
        """Validate."""
        if len(self.velocities) != len(self.times) or not self.times:
            raise InputError(
                "times",
                self.times,
                f"there must be one for each of {len(self.velocities)} velocities",
                "give as many times as velocities, at least one",
            )
        rule = Bounds(-LARGEST, LARGEST, "[]", "give a number in units of alpha g/p")
        velocities = tuple(rule("velocities", value) for value in self.velocities)
        object.__setattr__(self, "velocities", velocities)
        times, last = [], -1.0
        for given_time in self.times:
            hint = "give pivot times p t in order"
            time = in_range("times", given_time, 0.0, LONGEST_DURATION, "[]", hint=hint)
            if time <= last:
                valid = f"each must be after the one before, {last:.15g}"
                raise InputError("times", time, valid, hint)
            times.append(time)
            last = time
        object.__setattr__(self, "times", tuple(times))

    @classmethod
    def from_si(
        cls,
        block: Block,
        *,
        velocities_m_s: tuple[float, ...],
        times_s: tuple[float, ...] = (0.0,),
    ) -> "Impulses":
        """Return impulses in the measures of a given block.

        Parameters
        ----------
        block
            The block that is shaken.
        velocities_m_s
            Changes of the base velocity [m/s].
        times_s
            Times of the impulses [s].

        Raises
        ------
        InputError
            As for `Impulses`.

        Examples
        --------
        >>> block = Block.from_radius(alpha=0.2, radius=1.0)
        >>> [round(v, 6) for v in Impulses.from_si(block, velocities_m_s=(0.5,)).velocities]
        [0.69137]
        """
        unit = block.uplift_acceleration / block.p
        hint = "give numbers in m/s"
        return cls(
            velocities=tuple(finite("velocities_m_s", v, hint=hint) / unit for v in velocities_m_s),
            times=tuple(finite("times_s", t, hint="give seconds") * block.p for t in times_s),
        )

    def segments(self) -> tuple[Segment, ...]:
        """Return a still segment before the first impulse, and one after each."""
        ends = (*self.times[1:], math.inf)
        pieces = tuple(
            Segment(duration=end - start, jump=velocity)
            for start, end, velocity in zip(self.times, ends, self.velocities, strict=True)
        )
        return pieces if self.times[0] == 0.0 else (Segment(duration=self.times[0]), *pieces)
