"""Efficiency of a measure of intensity."""

from dataclasses import dataclass

from rocksteady.seismic.measures.scalar import Intensity


@dataclass(frozen=True, kw_only=True)
class Efficiency:
    """Efficiency of a measure of intensity in telling failures from survivals.

    Attributes
    ----------
    measure
        The measure, or a pair.
    state
        The damage state.
    status, median, beta
        Of the curve over the measure, as of `FragilityCurve`; NaN of a pair.
    log_likelihood, aic
        Of the single runs, and Akaike's criterion.
    """

    measure: tuple[Intensity, ...]
    state: str
    status: str
    median: float
    beta: float
    log_likelihood: float
    aic: float
