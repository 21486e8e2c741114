"""A horizontal and a vertical base motion together."""

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

from rocksteady.model.checks.arguments import checked
from rocksteady.model.motions.combine import scale
from rocksteady.model.motions.described_motion import DescribedMotion
from rocksteady.model.motions.segments import Motion

if TYPE_CHECKING:
    from rocksteady.model.motions.record import Record


@checked
@dataclass(frozen=True)
class BaseMotion(DescribedMotion):
    """Base motion of two components, both from the same moment on.

    A base that falls away under the block, at -g, ends a run as lost contact.  The linear model has
    no term for the vertical component.

    Parameters
    ----------
    horizontal
        The horizontal component.
    vertical
        The vertical component, upwards positive, linear between samples; none by default.

    Raises
    ------
    InputError
        If a component is no base motion.

    Examples
    --------
    >>> from rocksteady import BaseMotion, Record
    >>> across = Record(acceleration_m_s2=[0.0, 3.0, -3.0, 0.0], dt_s=0.2)
    >>> up = across.scaled(0.5)
    >>> motion = BaseMotion(across, up)
    >>> motion.reversed() == BaseMotion(across.reversed(), up)
    True
    """

    horizontal: "Motion | Record"
    vertical: "Motion | Record | None" = None

    def scaled(self, factor: float) -> "BaseMotion":
        """Return both components multiplied by a factor; a negative one reverses both.

        Raises
        ------
        InputError, ModelError
            As for `Record.scaled`, or `rocksteady.motions.scale` of another motion.
        """
        up = self.vertical
        return BaseMotion(
            _scaled(self.horizontal, factor), None if up is None else _scaled(up, factor)
        )

    def reversed(self) -> "BaseMotion":
        """Return the motion with the sign of its horizontal component alone changed."""
        return replace(self, horizontal=_scaled(self.horizontal, -1.0))


def _scaled(motion: "Motion | Record", factor: float) -> "Motion | Record":
    """Return a component multiplied by a factor."""
    return scale(motion, factor)
