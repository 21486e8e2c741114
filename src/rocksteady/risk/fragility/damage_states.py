"""Damage states of a block: uplift, a tilt that is exceeded, and overturning."""

import math
from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.typing import NDArray

from rocksteady.errors import InputError
from rocksteady.model.checks.arguments import checked
from rocksteady.model.checks.validation import non_negative
from rocksteady.outcomes import Status

UPLIFT: Final = "uplift"
OVERTURNED: Final = "overturned"


@checked
@dataclass(frozen=True)
class DamageState:
    """Damage state that a run exceeds or not.

    Parameters
    ----------
    name
        ``"uplift"`` for any rocking, ``"overturned"`` for a fall without return, or a name of its
        own with `peak`.
    peak
        Largest theta/alpha above which the state is exceeded, 0 or above; an overturned block
        exceeds every one.  None for the two states above.

    Raises
    ------
    InputError
        If another name comes without a peak, or one of the two with one.

    Examples
    --------
    >>> from rocksteady.risk import DamageState
    >>> DamageState("contents shifted", 0.1).peak
    0.1
    """

    name: str
    peak: float | None = None

    def __post_init__(self) -> None:
        """Validate."""
        if not isinstance(self.name, str):
            raise InputError("name", self.name, "it must be a text", "give one, as 'overturned'")
        known = self.name in (UPLIFT, OVERTURNED)
        if known and self.peak is not None:
            raise InputError("peak", self.peak, f"{self.name} is no tilt", "leave it out")
        if not known and (self.peak is None or not self.name.strip()):
            raise InputError(
                "name",
                self.name,
                "the states without a peak are uplift and overturned",
                "give one of them, or a name and a peak theta/alpha, as 0.5",
            )
        if self.peak is not None:
            hint = "give the theta/alpha that is exceeded, as 0.5"
            object.__setattr__(self, "peak", non_negative("peak", self.peak, hint=hint))

    @property
    def rank(self) -> float:
        """Place among nested states: each contains those of higher ranks."""
        if self.name == OVERTURNED:
            return math.inf
        return -1.0 if self.peak is None else self.peak


def exceeding(
    state: DamageState, status: NDArray[np.int8], peak_angle: NDArray[np.float64]
) -> NDArray[np.bool_]:
    """Return which runs exceed a damage state.

    Parameters
    ----------
    state
        The damage state.
    status, peak_angle
        Codes of `rocksteady.Status` and largest |theta|/alpha of the runs, of one shape.
    """
    fell: NDArray[np.bool_] = status == Status.OVERTURNED
    if state.name == OVERTURNED:
        return fell
    return fell | (peak_angle > (state.peak or 0.0))


DEFAULT_STATES: Final = (
    DamageState(UPLIFT),
    *(DamageState(f"theta/alpha > {peak:g}", peak) for peak in (0.25, 0.5, 1.0)),
    DamageState(OVERTURNED),
)


def state_of(given: DamageState | float | str) -> DamageState:
    """Return a damage state of a name, or of a peak theta/alpha, as a number or a text.

    Raises
    ------
    InputError
        As for `DamageState`.
    """
    if isinstance(given, DamageState):
        return given
    try:
        peak = float(given)
    except (TypeError, ValueError):
        return DamageState(given)  # type: ignore[arg-type]
    hint = "give the theta/alpha that is exceeded, as 0.5"
    return DamageState(f"theta/alpha > {non_negative('states', peak, hint=hint):g}", peak)
