"""Words of the restitution that free rocking shows."""

import math

from rocksteady.results.description import Column, Description, Fact, Table, doubt, line
from rocksteady.results.doubts import NOT_IDENTIFIED, TOO_FEW
from rocksteady.results.numbers import number, number_or_none, plural
from rocksteady.results.result import describes
from rocksteady.risk.free_rocking.restitution_fit import RestitutionFit

ANSWERED = ("scatter of impacts", "measuring error", "trend", "until 5 % of the peak")
"""Labels of facts that stand in the answer."""


@describes(RestitutionFit)
def describe_fit(fit: RestitutionFit) -> Description:
    """Return the estimates, the impacts and the remarks."""
    same = fit.restitution[0] == fit.restitution[1]
    sides = (0,) if same else (0, 1)
    words = " and ".join(number(fit.restitution[k], 4) for k in sides)
    identified = math.isfinite(fit.standard_error[0])
    errors = " and ".join(number(fit.standard_error[k], 2) for k in sides)
    spans = " and ".join(f"{number(fit.low[k], 4)} to {number(fit.high[k], 4)}" for k in sides)
    counted = plural(sum(2 if each.side == 0 else 1 for each in fit.impacts), "impact")
    facts = [
        Fact("restitution", list(fit.restitution), "restitution", words),
        Fact(
            "standard_error",
            [number_or_none(each) for each in fit.standard_error],
            "standard error",
            errors if identified else f"{NOT_IDENTIFIED}: {TOO_FEW} impacts",
        ),
        Fact("low", list(fit.low)),
        Fact("high", list(fit.high)),
        Fact("", label="90 % interval", text=spans),
    ]
    housner = None if fit.housner is None else list(fit.housner)
    plain = "none: so stocky a block does not rock on"
    if fit.housner is not None:
        plain = " and ".join(dict.fromkeys(number(each, 4) for each in fit.housner))
    facts.append(Fact("housner", housner, "Housner's", plain))
    if fit.factor is not None and fit.factor_error is not None:
        ratios = " and ".join(
            f"{number(fit.factor[k], 4)} ± {number(fit.factor_error[k], 2)}"
            for k in ((0,) if fit.factor[0] == fit.factor[1] else (0, 1))
        )
        facts += [
            Fact("factor", list(fit.factor), "e/Housner", ratios),
            Fact("factor_error", [number_or_none(each) for each in fit.factor_error]),
        ]
    high = None if math.isinf(fit.scatter_high) else fit.scatter_high
    beyond = "any" if high is None else number(high, 2)
    facts += [
        Fact(
            "scatter",
            number_or_none(fit.scatter),
            "scatter of impacts",
            f"{NOT_IDENTIFIED}: {TOO_FEW} impacts"
            if not identified
            else f"sd {number(fit.scatter, 2)} ({number(fit.scatter_low, 2)} to {beyond})",
        ),
        Fact("scatter_low", fit.scatter_low),
        Fact("scatter_high", high),
        Fact("sigma_estimated", fit.sigma_estimated),
    ]
    sigma = "given for each peak"
    if fit.sigma_rad is not None:
        estimated = " (estimated)" if fit.sigma_estimated else ""
        sigma = f"sd {number(1e3 * fit.sigma_rad)} mrad{estimated}"
    facts.append(Fact("sigma_rad", fit.sigma_rad, "measuring error", sigma))
    if fit.trend is not None and fit.trend_error is not None:
        trend = f"{number(fit.trend, 2)} ± {number(fit.trend_error, 2)} per theta/alpha"
        facts.append(Fact("trend", fit.trend, "trend", trend))
        facts.append(Fact("trend_error", fit.trend_error))
    if fit.half_periods is not None:
        times = f"{number(fit.half_periods)} of the computed ones"
        facts.append(Fact("half_periods", fit.half_periods, "half periods", times))
    counts = " and ".join(
        f"{'never' if count is None else plural(count, 'impact')} by {name}"
        for count, name in (
            (fit.to_small, "the fit"),
            (fit.to_small_housner, "Housner's value"),
        )
    )
    facts += [
        Fact("impacts_to_5_percent", fit.to_small, "until 5 % of the peak", counts),
        Fact("impacts_to_5_percent_housner", fit.to_small_housner),
        Fact("left_out", fit.left_out),
        Fact("model", fit.model.name),
        Fact("warnings", list(fit.warnings)),
    ]
    share = "" if fit.factor is None or not same else f", {number(fit.factor[0])} of Housner's"
    texts = {fact.label: fact.words for fact in facts}
    interval = f" (90 %: {spans})" if identified else ", without an interval: too few impacts"
    of_housner = ""
    if share and fit.factor is not None:
        of_housner = f", {fit.factor[0]:.3f} of Housner's {plain}"
    table = Table(
        "impacts",
        [vars(each) for each in fit.impacts],
        [
            Column("release", "test", left=True),
            Column("number", "impact"),
            Column("peak_rad", "peak [rad]"),
            Column("next_rad", "next [rad]"),
            Column("restitution", "restitution", lambda e: f"{e:.4f}"),
            Column("measuring_error", "± measuring"),
            Column("residual", "residual [sd]", lambda r: f"{r:+.1f}"),
        ],
        severity=lambda row: abs(row["residual"]),
    )
    return Description(
        headline=f"restitution {words}{share}, from {counted} of "
        f"{plural(len(fit.releases), 'release')}",
        facts=[
            line("in doubt", doubt(fit.warnings)),
            line("from", f"{counted} of {plural(len(fit.releases), 'release')}"),
            *(line(label, texts.get(label, "")) for label in ANSWERED),
            *facts,
        ],
        tables=[table],
        notes=fit.warnings,
        sentence=f"Restitution {words}{interval}{of_housner}.",
    )
