"""Efficiency of a measure of intensity."""

import math
from dataclasses import dataclass

from rocksteady.model.checks.arguments import checked_result
from rocksteady.results.description import Description, Fact
from rocksteady.results.numbers import number, number_or_none
from rocksteady.results.result import Result
from rocksteady.seismic.measures.scalar import Measure


@checked_result
@dataclass(frozen=True, kw_only=True, repr=False)
class Efficiency(Result):
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

    Examples
    --------
    >>> from rocksteady import Block, compute_fragility
    >>> from rocksteady.motions import make_synthetic_suite
    >>> from rocksteady.risk import FitOptions, Levels, RestitutionBand
    >>> fragility = compute_fragility(
    ...     Block.rectangle(width=0.3, height=1.5),
    ...     make_synthetic_suite(3),
    ...     levels=Levels("pgv_m_s", [0.2, 0.5, 1.0]),
    ...     restitution=RestitutionBand(draws=1),
    ...     fitting=FitOptions(states=["overturned"], bands=None),
    ... )
    >>> best = fragility.ranking[0]
    >>> best.measure[0].name, best.status
    ('pga_g', 'separated')
    """

    measure: tuple[Measure, ...]
    state: str
    status: str
    median: float
    beta: float
    log_likelihood: float
    aic: float

    @property
    def label(self) -> str:
        """The measure, or both of a pair, in words."""
        return " and ".join(part.label for part in self.measure)

    def describe(self) -> Description:
        """Return the dispersion of the curve over the measure, and how well it separates runs."""
        spread = "" if math.isnan(self.beta) else f"beta {number(self.beta)}, "
        return Description(
            headline=f"{self.label} for {self.state}: {spread}AIC {number(self.aic, 4)}",
            facts=[
                Fact("measure", self.label, "measure"),
                Fact("damage_state", self.state, "damage state"),
                Fact("status", self.status, "status"),
                Fact("median", number_or_none(self.median), "median", number(self.median)),
                Fact("beta", number_or_none(self.beta), "beta", number(self.beta)),
                Fact("log_likelihood", self.log_likelihood, "log-likelihood"),
                Fact("aic", self.aic, "Akaike's criterion"),
            ],
        )
