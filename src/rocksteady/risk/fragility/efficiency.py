"""Efficiency of a measure of intensity."""

from dataclasses import dataclass

from rocksteady.model.checks.arguments import checked_result
from rocksteady.seismic.measures.scalar import Measure


@checked_result
@dataclass(frozen=True, kw_only=True)
class Efficiency:
    """Efficiency of a measure of intensity in separating failures from survivals.

    Attributes
    ----------
    measure
        The measure, or a pair.
    state
        The damage state.
    status, median, beta
        As for `FragilityCurve`, of one curve without stages over the measure; NaN for a pair.
    log_likelihood, aic
        Log-likelihood of the single runs, and Akaike's criterion.
    """

    measure: tuple[Measure, ...]
    state: str
    status: str
    median: float
    beta: float
    log_likelihood: float
    aic: float
