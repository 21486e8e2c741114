"""Pictures of an assessment, each with the words for those who do not see it."""

import math

from rocksteady.results.numbers import chance, number, plural
from rocksteady.risk.assess.assessment import Assessment
from rocksteady.risk.counted.placing import Placing
from rocksteady.seismic.measures.free_sides import first_side
from rocksteady.show.assessment._assessment_tables import ends, level_words
from rocksteady.show.assessment._object_drawing import draw_object
from rocksteady.show.plots.risk.assessment import plot_assessment
from rocksteady.show.plots.risk.placed_spectra import DECIDING, plot_placed_spectra
from rocksteady.show.plots.risk.tornado import plot_tornado
from rocksteady.show.report import picture, twins
from rocksteady.show.style.wording import span, state_words
from rocksteady.words.placing import spectrum_remark

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
    shaking = assessment.judged.shaking
    if shaking is not None and shaking.placing is not None:
        block = None if assessment.described.on_floor else assessment.facts.block
        pictures["spectra"] = picture(
            lambda axes: plot_placed_spectra(shaking, axes, block=block),
            3.6,
            _words_of_spectra(shaking.placing),
        )
        pictures["spectra"]["caption"] = (
            "The spectrum is that of the ground: the motions reach the object through its floor."
            if block is None
            else f"Periods of {span(*DECIDING)} times 2π/p decide whether the object falls."
        )
    if assessment.fragility is None:
        return pictures
    pictures["shares"] = picture(
        lambda axes: plot_assessment(assessment, axes), 4.1, _words_of_shares(assessment)
    )
    bars = assessment.bars
    if bars and abs(bars[0][1] - bars[0][2]) > LEAST_BAR:
        base = assessment.cases[0].share
        pictures["tornado"] = picture(
            lambda axes: plot_tornado(bars, base, axes),
            1.1 + 1.2 * ROW * len(bars),
            f"Tornado plot about {chance(base)}; the widest bar is {bars[0][0]}, "
            f"{span(min(bars[0][1:]), max(bars[0][1:]), 100.0)} %.",
            rows=True,
        )
    return pictures


def _words_of_object(assessment: Assessment) -> str:
    """Return what the drawing of the object shows."""
    side = first_side(assessment.facts.block)
    return (
        f"The object to true scale on its two edges, its mass centre {number(side.centre_height)} "
        f"m above the ground, its slenderness {number(math.degrees(side.alpha))}°."
    )


def _words_of_spectra(placing: Placing) -> str:
    """Return what the picture of the spectra of the motions shows."""
    motions = plural(len(placing.shapes), "motion")
    mean = spectrum_remark(placing)
    return f"A design spectrum with the spectra of {motions} and their mean. {mean}"


def _words_of_shares(assessment: Assessment) -> str:
    """Return what the picture of the counted shares shows."""
    fragility, shaking = assessment.fragility, assessment.judged.shaking
    assert fragility is not None
    assert shaking is not None
    levels, (over, unit) = fragility.states[-1].curve.levels, level_words(assessment)
    names = ", ".join(state_words(each.state.name) for each in fragility.states)
    words = (
        f"Counted shares of the states {names} over {over} from "
        f"{span(float(levels[0]), float(levels[-1]))} {unit}; the demand is at "
        f"{number(shaking.level)} {unit}"
    )
    if assessment.share is not None and assessment.band is not None:
        words += f", where {chance(assessment.share)} fall, 90 %: {ends(assessment.band)}"
    return f"{words}."
