"""How many runs a calibration makes, and which seed decides the draws."""

from dataclasses import dataclass
from typing import Annotated, Final

from rocksteady.model.checks.arguments import checked
from rocksteady.model.checks.bounds import Bounds, Whole
from rocksteady.model.checks.validation import whole_number

LEAST_DRAWS: Final = 30
MOST_DRAWS: Final = 100_000
MOST_GAINS: Final = 1000
MOST_ROUNDS: Final = 6
EACH: Final = 100
"""Draws of a round, by default at least: fewer describe the posterior too badly for the next."""


@checked
@dataclass(frozen=True, kw_only=True)
class DrawOptions:
    """Draws of the parameters, gains of each, and rounds of refinement.

    Parameters
    ----------
    draws
        Draws of each object in all rounds together, default 1500.
    gains
        Gains that each draw and test is run at, default 2.  They are quantiles of the amplitude
        error in equal strata, shifted at random for each draw and test.
    rounds
        The first draws from the prior, each other from the posterior before it; default one for
        every 100 draws, 6 at most.  Rounds are left out once the error of every prediction is below
        `error`.
    error
        Monte Carlo error of a prediction that is small enough, default 0.01.
    seed
        Seed of all draws, default 0.

    Raises
    ------
    InputError
        If a number is outside its range, or there are more rounds than a fifth of the draws.

    Examples
    --------
    >>> from rocksteady.calibration import DrawOptions
    >>> DrawOptions(draws=300).per_round
    [100, 100, 100]
    """

    draws: Annotated[int, Whole(LEAST_DRAWS, MOST_DRAWS, "give a whole number, as 1500")] = 1500
    gains: Annotated[int, Whole(1, MOST_GAINS, "give a whole number, as 5")] = 2
    rounds: int | None = None
    error: Annotated[float, Bounds(0.0, 1.0, "(]", "give a probability, as 0.01")] = 0.01
    seed: Annotated[int, Whole(0, None, "give a whole number, as 0")] = 0

    def __post_init__(self) -> None:
        """Validate."""
        hint = "give a whole number, as 3, and at least five draws for each"
        whole_number("rounds", self._rounds, at_least=1, at_most=self.draws // 5, hint=hint)

    @property
    def _rounds(self) -> int:
        """Number of rounds: that given, or the default."""
        return min(MOST_ROUNDS, max(1, self.draws // EACH)) if self.rounds is None else self.rounds

    @property
    def per_round(self) -> list[int]:
        """Draws of each round."""
        share, rest = divmod(self.draws, self._rounds)
        return [share + (place < rest) for place in range(self._rounds)]
