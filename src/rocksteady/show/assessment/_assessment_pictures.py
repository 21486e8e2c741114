"""Pictures of an assessment, each with the words for those who do not see it."""

import math
from typing import TYPE_CHECKING, Any

from rocksteady.results.numbers import chance, number
from rocksteady.risk.assess.assessment import Assessment
from rocksteady.risk.assess.demand_in_units import demand_in_measure
from rocksteady.show.assessment._object_drawing import draw_object
from rocksteady.show.plots.risk.assessment import plot_assessment
from rocksteady.show.plots.risk.fragility import plot_fragility_states
from rocksteady.show.plots.risk.surface import plot_fragility_surface
from rocksteady.show.plots.risk.tornado import plot_measure_efficiency, plot_tornado
from rocksteady.show.report import picture, twins
from rocksteady.show.style.wording import greek, key_words, span, state_words

if TYPE_CHECKING:
    pass

ROW = 0.34
"""Height of a row of bars [inches]."""
LEAST_BAR = 1e-4
"""Width of the widest bar below which there is nothing to be seen."""


def pictures_of(assessment: Assessment) -> dict[str, dict[str, str]]:
    """Return addresses and alternative text of each picture that the assessment has.

    Each is drawn for a page ("source") and, with larger letters, for a phone ("narrow").
    """
    words = _words_of_object(assessment)
    pictures = {
        "object": twins(lambda _: draw_object(assessment.described), words, phone=False),
    }
    fragility = assessment.fragility
    if fragility is None:
        return pictures
    pictures["fragility"] = picture(
        lambda axes: plot_assessment(assessment, axes), 4.1, _words_of_curve(assessment)
    )
    if len(fragility.states) > 1:
        names = ", ".join(state_words(each.state.name) for each in fragility.states)
        pictures["states"] = picture(
            lambda axes: plot_fragility_states(fragility, axes, legend="below"),
            4.2,
            f"Shares of runs and fragility curves of the damage states {names}.",
        )
    if fragility.surface_words:
        demand = assessment.described.given.demand
        peaks = {"pga_g": demand.pga_g, "pgv_m_s": demand.pgv_m_s}
        pair = peaks if assessment.by_both_peaks is not None else {}
        pictures["surface"] = picture(
            lambda axes: plot_fragility_surface(fragility, axes, **pair),
            4.4,
            "Shares of the runs that fall over PGA and PGV, with lines of 10, 50 and 90 %.",
        )
    ranked = [each for each in fragility.ranking if math.isfinite(each.aic)]
    if len(ranked) > 1 and any(each.beta > 0.0 for each in ranked):
        best = " and ".join(greek(part.label) for part in ranked[0].measure)
        pictures["ranking"] = picture(
            lambda axes: plot_measure_efficiency(fragility, axes),
            0.7 + ROW * len(ranked),
            f"Bars of AIC for {len(ranked)} measures of intensity; the best is {best}.",
            rows=True,
        )
    bars = tornado_rows(assessment)
    if bars and abs(bars[0][1] - bars[0][2]) > LEAST_BAR:
        base = assessment.case_probabilities[0]
        pictures["tornado"] = picture(
            lambda axes: plot_tornado(
                [(name, 100.0 * low, 100.0 * high) for name, low, high in bars],
                100.0 * base,
                axes,
                label="probability of falling at the demand [%]",
            ),
            1.1 + 1.2 * ROW * len(bars),
            f"Tornado plot about {chance(base)}; the widest bar is {bars[0][0]}, "
            f"{span(min(bars[0][1:]), max(bars[0][1:]), 100.0)} %.",
            rows=True,
        )
    return pictures


def tornado_rows(assessment: Assessment) -> list[tuple[str, float, float]]:
    """Return assumption, and probability at its low and at its high end, the widest first.

    An assumption that is changed to one side alone has the object as described at its other end.
    """
    if not assessment.cases:
        return []
    base, *shares = assessment.case_probabilities
    changes = dict[str, list[Any]]()
    for case, share in zip(assessment.cases[1:], shares, strict=True):
        changes.setdefault(case.parameter, []).append((case, share))
    rows = []
    for parameter, cases in changes.items():
        name = key_words(parameter)
        (first, low), (last, high) = cases[0], cases[-1]
        if len(cases) > 1:
            ends = " to ".join(case.change.removesuffix(" alone") for case in (first, last))
            words = f"{name}, {ends}"
            rows.append((words, low, high))
        elif first.change.startswith(("-", "−")):
            rows.append((f"{name}, {first.change}", low, base))
        else:
            rows.append((f"{name}, {first.change}", base, low))
    rows = [row for row in rows if all(math.isfinite(end) for end in row[1:])]
    return sorted(rows, key=lambda row: -abs(row[1] - row[2]))


def _words_of_object(assessment: Assessment) -> str:
    """Return what the drawing of the object shows."""
    from rocksteady.seismic.measures.free_sides import first_side

    side = first_side(assessment.facts.block)
    return (
        f"The object to true scale on its two edges, its mass centre {number(side.centre_height)} "
        f"m above the ground, its slenderness {number(math.degrees(side.alpha))}°."
    )


def _words_of_curve(assessment: Assessment) -> str:
    """Return what the fragility plot shows."""
    fragility, curve = assessment.fragility, assessment.curve
    assert fragility is not None
    assert curve is not None
    name = greek(str(fragility.measure))
    words = f"Probability of falling over {name}, run from {span(*curve.sampled)}"
    if math.isfinite(curve.median):
        words += f", median {number(curve.median)}"
    demand = demand_in_measure(assessment)
    if math.isfinite(demand):
        words += f"; the demand is at {number(demand)}, with {chance(assessment.by_curve)}"
    return f"{words}."
