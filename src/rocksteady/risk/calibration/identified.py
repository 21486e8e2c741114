"""What follows from outcomes for each parameter: prior beside posterior, and a verdict."""

from collections.abc import Mapping
from typing import Any

import numpy as np

from rocksteady.arrays import Floats
from rocksteady.kernels.elementary.arrays import log
from rocksteady.results.doubts import ANSWER_DRAWS, FEWEST_DRAWS, NOT_IDENTIFIED, TOO_FEW
from rocksteady.results.numbers import number_or_none
from rocksteady.risk.calibration.held_out.leaving_out import weighted_quantiles
from rocksteady.risk.calibration.posterior import Posterior
from rocksteady.risk.calibration.sampler.exact import effective, softmax
from rocksteady.risk.calibration.sampler.outcome_likelihood import LEAST
from rocksteady.risk.calibration.sampler.rounds import Fit
from rocksteady.risk.observations.object_prior import BOUNDS

IDENTIFIED, BOUND, RETURNED = "identified", "bound", "prior returned"
LIMIT, NARROWED = "at the prior's limit", "narrowed"
NARROW = 0.7
"""Standard deviation over that of the prior below which outcomes are informative."""
HALF = 0.5
"""Interval of 90 % over that of the prior below which a number is identified."""
EDGE, CROWD = 0.01, 10.0
"""Share of the prior at one of its ends, and the growth of the odds there that contradicts it."""
MEANINGS: Mapping[str, str] = {
    IDENTIFIED: "outcomes fix it: its interval of 90 % is under half of the prior's",
    BOUND: "outcomes of one kind bound it on one side, at 90 %",
    RETURNED: "outcomes do not inform it: its prior comes back",
    LIMIT: "outcomes push it beyond an end of its prior: doubt the prior, or the model",
    NOT_IDENTIFIED: f"fewer than {ANSWER_DRAWS:g} effective draws, {TOO_FEW} for an estimate",
    NARROWED: "narrower than its prior, but not to half of it: not identified",
}


def contradictions(fit: Fit) -> dict[str, str]:
    """Return the ends of priors that outcomes lie beyond: "lower" or "upper", by name.

    The odds of the outer 1 % of the prior of a number have grown more than tenfold.  So have those
    of an error, with ln of its odds straight through its outer two nodes, and the outer node is ten
    times as likely as the next.  The limit of what is possible is no such end, and outcomes of one
    kind bound a prior without contradicting it.
    """
    ends: dict[str, str] = {}
    space, weights = fit.bench.space, fit.weights
    alike = len({test.fell for test in fit.bench.tests} - {None}) < 2
    if alike or effective(weights) < FEWEST_DRAWS:
        return ends
    for place, name in enumerate(space.names):
        spread, values = space.block.spreads[name], fit.values[:, place]
        low, high = spread.quantile([EDGE, 1.0 - EDGE]).tolist()
        for side, inside, limit in (
            ("lower", values < low, spread.low <= BOUNDS[name][0]),
            ("upper", values > high, spread.high >= BOUNDS[name][1]),
        ):
            if not limit and _grown(float(weights[inside].sum()), EDGE):
                ends[name] = side
    like = fit.likelihood
    cells = softmax(fit.cells + like.grid + fit.base[:, np.newaxis, np.newaxis, np.newaxis])
    prior = softmax(like.grid)
    for axis, name in enumerate(("sigma_ln", "session_ln", "outliers")):
        others = tuple(each for each in range(3) if each != axis)
        likely = cells.sum(axis=0).sum(axis=others) / prior.sum(axis=others)
        logs = log(np.maximum(likely, LEAST))
        steps = (("lower", 0, 1), ("upper", -1, -2)) if len(logs) > 1 else ()
        for side, end, following in steps:
            gap = 0.5 * float(np.ptp(np.polynomial.legendre.leggauss(len(logs))[0][:2]))
            possible = side == "upper" or getattr(like.noise, name).low > 0.0
            if possible and logs[end] - logs[following] > max(np.log(CROWD), CROWD * gap):
                ends[name] = side
    return ends


def _grown(after: float, before: float) -> bool:
    """Return whether odds have grown so far that the prior is contradicted."""
    return after * (1.0 - before) > CROWD * before * (1.0 - after)


def parameters_of(
    posterior: Posterior,
    prior: Mapping[str, Floats],
    fell: Floats,
    ends: Mapping[str, str],
    outline_alpha_rad: float,
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
    ends
        From `contradictions`.
    outline_alpha_rad
        Slenderness that the given sizes show.
    """
    known = fell[np.isfinite(fell)]
    one_sided = len(known) > 0 and (known == known[0]).all()
    rows = []
    for name in (*posterior.columns, *posterior.errors):
        before = prior[name]
        low, high = np.quantile(before, [0.05, 0.95])
        median, below, above = posterior.interval(name)
        ratio = posterior.deviation(name) / float(before.std()) if before.std() > 0.0 else 1.0
        row: dict[str, Any] = {
            "object": posterior.object,
            "parameter": name,
            "prior_low": float(low),
            "prior_high": float(high),
            "median": number_or_none(median),
            "low": number_or_none(below),
            "high": number_or_none(above),
            "sd_ratio": ratio if posterior.identified else None,
            "verdict": LIMIT if name in ends else _verdict(name, posterior, before, ratio),
            "bound": None,
            "bound_side": None,
        }
        if name == "alpha_rad":
            row["outline"] = outline_alpha_rad
            if one_sided and posterior.identified:
                side, at = ("upper", 0.9) if known[0] else ("lower", 0.1)
                values = posterior.of(name)[:, np.newaxis]
                row |= {
                    "verdict": BOUND,
                    "bound": float(weighted_quantiles(values, posterior.weights, (at,))[0, 0]),
                    "bound_side": side,
                }
        rows.append(row)
    return rows


def _verdict(name: str, posterior: Posterior, before: Floats, ratio: float) -> str:
    """Return the verdict of a number under outcomes of both kinds."""
    if not posterior.identified:
        return NOT_IDENTIFIED
    median, low, high = posterior.interval(name)
    if before.std() <= 1e-12 * (1.0 + abs(float(before.mean()))):
        return RETURNED
    ends = np.quantile(before, [0.05, 0.95])
    if not ends[0] <= median <= ends[1]:
        return LIMIT
    if ratio >= NARROW:
        return RETURNED
    return IDENTIFIED if high - low < HALF * (ends[1] - ends[0]) else NARROWED
