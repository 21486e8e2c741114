"""What follows from outcomes for each parameter: prior beside posterior, and a verdict."""

from collections.abc import Mapping
from typing import Any

import numpy as np

from rocksteady.arrays import Floats
from rocksteady.results.doubts import ENOUGH_DRAWS, FEWEST_DRAWS, NOT_IDENTIFIED, TOO_FEW
from rocksteady.results.numbers import number_or_none
from rocksteady.risk.calibration.held_out.folds import weighted_quantiles
from rocksteady.risk.calibration.posterior import Posterior

IDENTIFIED, BOUND, RETURNED = "identified", "bound", "prior returned"
LIMIT, NARROWED = "at the prior's limit", "narrowed"
NARROW = 0.7
"""Standard deviation over that of the prior below which outcomes are informative."""
HALF = 0.5
"""Interval of 90 % over that of the prior below which a number is identified."""
EDGE, CROWD = 0.05, 0.3
"""Share of the prior at one of its ends, and the share of the posterior there that is too much."""
MEANINGS: Mapping[str, str] = {
    IDENTIFIED: "outcomes fix it: its interval of 90 % is under half of the prior's",
    BOUND: "outcomes of one kind bound it on one side, at 90 %",
    RETURNED: "outcomes do not inform it: its prior comes back",
    LIMIT: "outcomes push it to an end of its prior: widen the prior, or doubt the model",
    NOT_IDENTIFIED: f"fewer than {FEWEST_DRAWS:g} effective draws, {TOO_FEW} for an estimate",
    NARROWED: "narrower than its prior, but not to half of it, or by too few draws: not identified",
}


def parameters_of(
    posterior: Posterior, prior: Mapping[str, Floats], fell: Floats
) -> list[dict[str, Any]]:
    """Return a row for each parameter and derived number of an object.

    A number is identified if its interval of 90 % is under half of the prior's; of most tests that
    is alpha alone.  With outcomes of one kind alpha has one
    bound: `bound` and `bound_side` hold the 10 % or the 90 % quantile of the posterior.

    Parameters
    ----------
    posterior
        Posterior of the object.
    prior
        Values of draws of the prior by name, as `Posterior.columns`.
    fell
        Outcomes of the object, nan of unknown ones.
    """
    known = fell[np.isfinite(fell)]
    one_sided = len(known) > 0 and (known == known[0]).all()
    rows = []
    for name, values in posterior.columns.items():
        before = prior[name]
        low, high = np.quantile(before, [0.05, 0.95])
        median, below, above = posterior.interval(name)
        mean = float(posterior.weights @ values)
        sd = float(np.sqrt(posterior.weights @ np.square(values - mean)))
        ratio = sd / float(before.std()) if before.std() > 0.0 else 1.0
        row: dict[str, Any] = {
            "object": posterior.object,
            "parameter": name,
            "prior_low": float(low),
            "prior_high": float(high),
            "median": number_or_none(median),
            "low": number_or_none(below),
            "high": number_or_none(above),
            "sd_ratio": ratio if posterior.identified else None,
            "verdict": _verdict(name, posterior, values, before, ratio),
            "bound": None,
            "bound_side": None,
        }
        if name == "alpha_rad":
            row["outline"] = posterior.space.block.outline_alpha_rad
            if one_sided and posterior.identified:
                side, at = ("upper", 0.9) if known[0] else ("lower", 0.1)
                weights = posterior.weights[:, np.newaxis]
                row |= {
                    "verdict": BOUND,
                    "bound": float(weighted_quantiles(values[:, np.newaxis], weights, (at,))[0, 0]),
                    "bound_side": side,
                }
        rows.append(row)
    return rows


def _verdict(name: str, posterior: Posterior, values: Floats, before: Floats, ratio: float) -> str:
    """Return the verdict of a number under outcomes of both kinds."""
    if not posterior.identified:
        return NOT_IDENTIFIED
    if before.std() <= 1e-12 * (1.0 + abs(float(before.mean()))):
        return RETURNED
    ends = np.quantile(before, [EDGE, 1.0 - EDGE])
    outside = (
        float(posterior.weights[values < ends[0]].sum()),
        float(posterior.weights[values > ends[1]].sum()),
    )
    if max(outside) > CROWD:
        return LIMIT
    if ratio >= NARROW:
        return RETURNED
    _, low, high = posterior.interval(name)
    narrow = high - low < HALF * (ends[1] - ends[0])
    return IDENTIFIED if narrow and posterior.effective_draws >= ENOUGH_DRAWS else NARROWED
