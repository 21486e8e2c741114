"""What shakings a back-analysis tries: limits, levels, draws and temper."""

from dataclasses import dataclass
from typing import Annotated, Literal

from rocksteady.errors import InputError
from rocksteady.model.checks.arguments import checked
from rocksteady.model.checks.bounds import Bounds, Whole
from rocksteady.model.checks.validation import LARGEST, in_range

MOST_LEVELS = 200
MOST_DRAWS = 10_000


def _limits(name: str, value: tuple[float, float]) -> tuple[float, float]:
    """Return the lowest and the highest scale."""
    rule = Bounds(1.0 / LARGEST, LARGEST, "[]", "as (0.05, 2)")
    low, high = (rule(name, each) for each in value)
    if low >= high:
        raise InputError(name, (low, high), "the first is below the second", "exchange the two")
    return low, high


def _temper(name: str, value: float | str) -> float | str:
    """Return an exponent, or "auto"."""
    if value == "auto":
        return value
    return in_range(name, value, 0.0, 1.0, "(]", hint="give an exponent, as 0.3, or 'auto'")


@checked
@dataclass(frozen=True, kw_only=True)
class ScanOptions:
    """Shakings that a back-analysis tries.

    Parameters
    ----------
    limits
        Lowest and highest value of the first measure, between which its logarithm is equally likely
        before the survey; by default from where no object lifts to where nearly all fall.
    levels
        Number of scales of each record between the limits; default 22.
    draws
        Number of draws of each object at each scale; by default 320 over the number of objects, at
        least 8 and at most 64.
    temper
        Exponent of the likelihood in (0, 1], or "auto" (default) for the largest of which the
        region covers records that are left out.
    trials
        Simulated surveys for each record that is left out; default 4, and 0 for no check.
    seed
        A whole number of 0 or above; default 0.

    Raises
    ------
    InputError
        If a number is outside its range, the limits are not two in order, or "auto" meets no
        trials.

    Examples
    --------
    >>> from rocksteady.calibration import ScanOptions
    >>> ScanOptions(limits=(0.05, 1.5), draws=16).temper
    'auto'
    """

    limits: Annotated[tuple[float, float] | None, _limits] = None
    levels: Annotated[int, Whole(4, MOST_LEVELS, "leave it out")] = 22
    draws: Annotated[int | None, Whole(2, MOST_DRAWS, "give a number, as 16")] = None
    temper: Annotated[float | Literal["auto"], _temper] = "auto"
    trials: Annotated[int, Whole(0, 1000, "leave it out")] = 4
    seed: Annotated[int, Whole(0, None, "give a seed, as 0")] = 0

    def __post_init__(self) -> None:
        """Validate."""
        if self.temper == "auto" and not self.trials:
            valid = "a temper is chosen by simulated surveys"
            raise InputError("trials", 0, valid, "give a number above 0, or a temper")

    def draws_of(self, objects: Annotated[int, Whole(1, None, "give how many there are")]) -> int:
        """Return the number of draws of each of some objects at each scale."""
        return self.draws or min(64, max(8, -(-320 // objects)))
