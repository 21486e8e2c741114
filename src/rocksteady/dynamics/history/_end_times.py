"""Times at which a run ends, in seconds and in tau."""

from typing import TYPE_CHECKING

from rocksteady.model.motions.segments import Harmonic

if TYPE_CHECKING:
    from rocksteady.model.blocks.block import Block
    from rocksteady.model.motions.record import Record
    from rocksteady.model.motions.segments import Motion


class EndTimes:
    """Times of a run in seconds and in tau = omega t, from those in pivot time."""

    if TYPE_CHECKING:
        block: Block | None
        motion: Motion | Record

        @property
        def end_time_pt(self) -> float: ...

        @property
        def rest_time_pt(self) -> float | None: ...

        @property
        def overturn_time_pt(self) -> float | None: ...

    def _seconds(self, pt: float | None) -> float | None:
        return None if pt is None or self.block is None else pt / self.block.p

    def _tau(self, pt: float | None) -> float | None:
        if pt is None or not isinstance(self.motion, Harmonic):
            return None
        return pt * self.motion.frequency_ratio

    @property
    def end_time_s(self) -> float | None:
        """Time up to which the trajectory reaches [s]; None without a `Block`."""
        return self._seconds(self.end_time_pt)

    @property
    def rest_time_s(self) -> float | None:
        """Time at which the block came to rest [s]; None without a `Block`, or if it did not."""
        return self._seconds(self.rest_time_pt)

    @property
    def overturn_time_s(self) -> float | None:
        """Time of overturning [s]; None without a `Block`, or if it does not overturn."""
        return self._seconds(self.overturn_time_pt)

    @property
    def end_time_tau(self) -> float | None:
        """Time up to which the trajectory reaches, omega t; None unless `Harmonic`."""
        return self._tau(self.end_time_pt)

    @property
    def rest_time_tau(self) -> float | None:
        """Time at which the block came to rest, omega t; None unless `Harmonic`."""
        return self._tau(self.rest_time_pt)

    @property
    def overturn_time_tau(self) -> float | None:
        """Time of overturning, omega t; None unless `Harmonic`, or if it does not overturn."""
        return self._tau(self.overturn_time_pt)
