"""Balanced rocks: which branches of a hazard model an object that still stands rejects."""

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Annotated, Any

import numpy as np
from numpy.typing import NDArray

from rocksteady.arrays import Floats
from rocksteady.errors import InputError
from rocksteady.model.blocks.block import Block
from rocksteady.model.checks.arguments import checked, checked_result
from rocksteady.model.checks.bounds import INSIDE, Bounds
from rocksteady.results.numbers import plural
from rocksteady.results.result import Result
from rocksteady.results.words import Label
from rocksteady.risk.hazard._sum import mass_of
from rocksteady.risk.hazard.failure_risk import known, risk_of
from rocksteady.risk.hazard.fragile import Fragile, Given, fragile_of
from rocksteady.risk.hazard.hazard_curve import HazardCurve
from rocksteady.risk.hazard.hazard_measures import written
from rocksteady.seismic.measures.scalar import Measure

NODES = 32
"""Of Gauss and Hermite's rule over ln alpha."""
OLDEST_YEARS = 1e9


@checked_result
@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class HazardBranchCheck(Result):
    """Test of hazard branches against a standing object, from `check_hazard_branches`.

    Attributes
    ----------
    fragility, branches
        What was given.
    measure, age_years, alpha_cv, level
        As given to `rocksteady.risk.check_hazard_branches`.
    annual_rates
        Rate of toppling on each branch, the mean over alpha [1/year], shape (branches,).
    survival
        Probability that the object still stands: the mean over alpha of exp(-age rate).
    prior, posterior
        Weight of each branch before and after the observation; each sums to 1, and the posterior
        is NaN where no branch lets the object stand.
    """

    fragility: Given
    branches: tuple[HazardCurve, ...]
    measure: Measure
    age_years: Annotated[float, Label("Age", unit="years")]
    alpha_cv: Annotated[float, Label("Coefficient of variation of alpha")]
    level: Annotated[float, Label("Level of rejection")]
    annual_rates: Floats
    survival: Floats
    prior: Floats
    posterior: Floats

    @property
    def confidence(self) -> Floats:
        """Probability that the object would have fallen: 1 - survival."""
        return np.subtract(1.0, self.survival)

    @property
    def rejected(self) -> NDArray[np.bool_]:
        """Whether the confidence reaches the level."""
        return np.greater_equal(self.confidence, self.level)

    def rows(self) -> list[dict[str, Any]]:
        """Return rate, survival, verdict and weights of each branch."""
        return [
            {
                "branch": curve.name or str(at + 1),
                "annual_rate": float(self.annual_rates[at]),
                "survival": float(self.survival[at]),
                "confidence": float(self.confidence[at]),
                "rejected": bool(self.rejected[at]),
                "prior": float(self.prior[at]),
                "posterior": None if math.isnan(self.posterior[at]) else float(self.posterior[at]),
            }
            for at, curve in enumerate(self.branches)
        ]


@checked
def check_hazard_branches(
    fragility: Annotated[Given, INSIDE],
    branches: Sequence[HazardCurve],
    age_years: Annotated[float, Bounds(0.0, OLDEST_YEARS, "(]", "give an age in years")],
    *,
    measure: Measure | str | None = None,
    block: Block | None = None,
    alpha_cv: Annotated[float, Bounds(0.0, 1.0, "[]", "give a share, as .05")] = 0.05,
    level: Annotated[float, Bounds(0.0, 1.0, "()", "give a confidence, as .95")] = 0.95,
) -> HazardBranchCheck:
    """Test branches of a hazard model against a standing object.

    If it topples at a rate r, it stands for its age with the probability exp(-age r): a branch is
    rejected at the confidence 1 - exp(-age r).  The alpha of an object in the field is known to
    some per cent.  Its capacity goes with tan alpha, as in PGA/(g tan alpha) and p PGV/(g tan
    alpha), whose p depends on the size alone.  So the fragility's intensities are multiplied by a
    lognormal factor of median 1, and the survival is averaged over it by Gauss and Hermite's rule;
    not the rate, as the object has one alpha at all times.

    Parameters
    ----------
    fragility
        Fragility of toppling, as for `rocksteady.compute_risk`.
    branches
        Hazard curves of one measure, with their weights or all without: then equal ones.
    age_years
        Time that the object has stood in its present shape [years].
    measure, block
        As for `rocksteady.compute_risk`; default None, the branches' own measure.
    alpha_cv
        Coefficient of variation of tan alpha, in [0, 1]; default 0.05.
    level
        Confidence at which a branch is rejected, in (0, 1); default 0.95.

    Returns
    -------
    HazardBranchCheck
        Of each branch rate, survival, confidence, verdict and posterior weight.

    Raises
    ------
    InputError
        If there is no branch, their measures differ, some have weights and others none, or what
        `rocksteady.compute_risk` refuses.

    References
    ----------
    J. W. Baker, N. A. Abrahamson, J. W. Whitney, M. P. Board and T. C. Hanks, Bull. Seismol. Soc.
    Am. 103 (2013), of fragile geologic structures as tests of hazard.

    Examples
    --------
    >>> from rocksteady.risk import HazardCurve, check_hazard_branches
    >>> low = HazardCurve(measure="pga_g", levels=[0.1, 1.0], rates=[1e-3, 1e-6], name="low")
    >>> high = HazardCurve(measure="pga_g", levels=[0.1, 1.0], rates=[1e-2, 1e-4], name="high")
    >>> test = check_hazard_branches((0.3, 0.4), [low, high], 10_000.0)
    >>> test.rejected.tolist(), test.confidence.round(2).tolist()
    ([False, True], [0.53, 1.0])
    """
    prior = _prior(branches)
    fragile = fragile_of(fragility, branches[0], measure, block)
    for hazard in branches:
        known(risk_of(fragile, hazard, age_years))
    factors, weights = lognormal_rule(alpha_cv)
    rates = np.array(
        [
            [_rate(replace(fragile, factor=fragile.factor / each), hazard) for each in factors]
            for hazard in branches
        ]
    )
    survival = np.exp(-age_years * rates) @ weights
    total = float(prior @ survival)
    return HazardBranchCheck(
        fragility=fragile.given,
        branches=tuple(branches),
        measure=fragile.measure,
        age_years=age_years,
        alpha_cv=alpha_cv,
        level=level,
        annual_rates=rates @ weights,
        survival=np.minimum(survival, 1.0),
        prior=prior,
        posterior=prior * survival / total if total > 0.0 else np.full(len(prior), math.nan),
    )


def lognormal_rule(cv: float) -> tuple[Floats, Floats]:
    """Return nodes and weights of the mean over a lognormal factor of median 1.

    Parameters
    ----------
    cv
        Its coefficient of variation.
    """
    if cv == 0.0:
        return np.ones(1), np.ones(1)
    nodes, weights = np.polynomial.hermite_e.hermegauss(NODES)
    sigma = math.sqrt(math.log1p(cv * cv))
    return np.exp(sigma * nodes), weights / weights.sum()


def _rate(fragile: Fragile, hazard: HazardCurve) -> float:
    """Return the rate of toppling under a hazard curve."""
    mass = mass_of(hazard, fragile.edges / fragile.factor)
    return math.fsum((fragile.at(mass.levels) * mass.rates).tolist())


def _prior(branches: Sequence[HazardCurve]) -> Floats:
    """Return the weights of branches, which sum to 1, or raise where they cannot be compared."""
    hint = "give what read_hazard_curves returns"
    if not branches:
        raise InputError("branches", len(branches), "there must be one or more", hint)
    measures = {written(curve.intensity) for curve in branches}
    if len(measures) > 1:
        raise InputError(
            "branches",
            ", ".join(sorted(measures)),
            "they must be of one measure",
            "test those of each measure by themselves",
        )
    sites = {curve.site for curve in branches if curve.site is not None}
    if len(sites) > 1:
        raise InputError(
            "branches",
            plural(len(sites), "site"),
            "the object stands at one site",
            "give the curves of its site",
        )
    weights = [curve.weight for curve in branches]
    given = [weight for weight in weights if weight is not None]
    if given and len(given) < len(weights):
        raise InputError(
            "branches",
            f"{len(given)} of {len(weights)} with a weight",
            "all have one, or none",
            "give each its weight with dataclasses.replace(curve, weight=...)",
        )
    row = np.array(given) if given else np.ones(len(weights))
    return np.asarray(row / row.sum(), dtype=np.float64)
