"""Verdict, colour, sentence and reason of an assessment."""

from dataclasses import dataclass
from typing import NamedTuple

from rocksteady.model.checks.confidence import CONFIDENCE
from rocksteady.results.numbers import chance, counted, interval, number, plural, quantity
from rocksteady.risk.assess._demand_level import DemandLevel
from rocksteady.risk.assess._probability import EXTRAPOLATED, NO_ANSWER, Onset, Probability
from rocksteady.risk.assess._remedies import Remedy
from rocksteady.risk.assess._sensitivity import Case, as_described, bar_words, tornado
from rocksteady.risk.assess.described.facts import ObjectFacts
from rocksteady.risk.assess.described.objects import parameter_words
from rocksteady.risk.assess.two_numbers import share_words
from rocksteady.risk.screens.demand import Demand

AMBER = 0.2
"""Share of the target probability up to which an object is green; up to the target it is amber."""

WORDS = {"green": "low", "amber": "raised", "red": "high", "grey": "no answer"}
"""What a colour stands for, for those who do not see it."""


MET = ("stands", "below target")
"""Verdicts on an object that meets its target."""


class Answer(NamedTuple):
    """What a client reads first."""

    verdict: str
    colour: str
    sentence: str
    reason: str


@dataclass(frozen=True, kw_only=True)
class Findings:
    """The numbers that an answer is made of.

    Attributes
    ----------
    facts
        What follows from the geometry.
    level, demand
        The demand, and the demand in words.
    onset
        What its PGA begins, with the friction needed.
    target
        Probability that is accepted.
    answer, cases
        Probability of falling at the demand, and cases with one thing changed; none where it
        slides.
    remedy
        That of the least change, where one is needed.
    on_floor
        Whether it stands on a floor of a building, whose peaks are the demand's of the facts.
    """

    facts: ObjectFacts
    level: DemandLevel
    demand: str
    onset: Onset
    target: float
    answer: Probability = NO_ANSWER
    cases: tuple[Case, ...] = ()
    remedy: Remedy | None = None
    on_floor: bool = False

    @property
    def peak(self) -> str:
        """The peak acceleration in words, with the vertical motion."""
        return peak_words(self.facts.demand, on_floor=self.on_floor)


def peak_words(demand: Demand, *, on_floor: bool = False) -> str:
    """Return the peak acceleration of a demand in words, with its vertical motion."""
    name = "peak floor acceleration" if on_floor else "PGA"
    words = f"a {name} of {quantity(demand.pga_g or 0.0, 'g')}"
    return f"{words} with {demand.vertical_words}" if demand.vertical_words else words


def verdict_of(answer: Probability, target: float) -> str:
    """Return the verdict on a probability in two words."""
    if answer.value is None:
        return "slides" if answer.basis is None else "undecided"
    if answer.basis == "statics":
        return "stands"
    return "above target" if answer.value > target else "below target"


def colour_of(probability: float | None, target: float) -> str:
    """Return green up to a fifth of the target, amber up to the target, red above.

    Examples
    --------
    >>> [colour_of(share, 0.1) for share in (0.02, 0.1, 0.2, None)]
    ['green', 'amber', 'red', 'grey']
    """
    if probability is None:
        return "grey"
    if probability <= AMBER * target:
        return "green"
    return "amber" if probability <= target else "red"


def answer_of(findings: Findings) -> Answer:
    """Return the answer of some numbers, for a client."""
    facts, remedy, target = findings.facts, findings.remedy, findings.target
    answer, need = findings.answer, findings.onset.friction_needed
    lifts = f"It lifts at {quantity(facts.uplift_pga_g, 'g')}"
    verdict, colour = verdict_of(answer, target), colour_of(answer.value, target)
    if verdict == "slides":
        assert need is not None  # without a PGA nothing is known to slide
        low = facts.friction[0] if facts.friction else 0.0
        return Answer(
            verdict,
            colour,
            f"{facts.name} slides at {findings.peak}: rocking is no answer, and no "
            "probability of falling is given.",
            f"Rocking alone needs a coefficient of friction of {number(need.largest)} for "
            f"{need.cause}; the lowest given is {number(low)}. Analyse the sliding, leave room for "
            "it, or measure a higher friction.",
        )
    if answer.basis == "statics":
        return Answer(
            verdict,
            colour,
            f"{facts.name} stays where it stands: {findings.peak} does not lift it.",
            f"{lifts}. The fragility curve is of motions scaled to the demand's intensity, some of "
            "which have a higher PGA.",
        )
    that = " that lift" if findings.level.measure.given_uplift else ""
    if answer.value is None:
        return Answer(
            verdict,
            colour,
            f"No answer yet for {facts.name}: no run lifts at "
            f"{with_article(findings.level.words)}.",
            f"{lifts}; the demand is {findings.demand}. Give motions of a higher PGA at this PGV.",
        )
    side = "more than" if verdict == "above target" else "within"
    base = findings.cases[0]
    its = f"its {plural(base.trials, 'run')}{that}"
    runs = counted(base.fell, its)
    share = f"{runs[0].upper()}{runs[1:]}"  # no smaller than one of the runs
    percents = "; ".join(
        [
            *([chance(answer.value)] if 0 < base.fell < base.trials else []),
            interval(answer.band, CONFIDENCE).strip(" ()"),
        ]
    )
    if answer.by_curve is not None:
        share = f"{share_words(answer.by_curve)} objects of this shape and size would fall"
        by_count, percents = percents, chance(answer.by_curve)
        if answer.extrapolated:
            percents += f", {EXTRAPOLATED}"
        if answer.basis == "count":
            percents += f"), but {runs} there ({by_count}"
    sentence = (
        f"{share} at {with_article(findings.level.words)} ({percents}): {side} the "
        f"target of {number(100.0 * target)} %."
    )
    if remedy is not None:
        sentence = f"{sentence[:-1]}; the least change that meets the target is to {remedy.words}."
    return Answer(verdict, colour, sentence, _reason(findings, lifts))


def with_article(words: str) -> str:
    """Return words with the indefinite article before them, as "an Sa(1 s) of 0.3 g"."""
    return f"{'an' if words.startswith('Sa') else 'a'} {words}"


def _reason(findings: Findings, lifts: str) -> str:
    """Return why: uplift, the median, and what matters most."""
    base = findings.cases[0]
    that = " that lift" if findings.level.measure.given_uplift else ""
    fell = f"{base.fell:,}" if base.fell else "none"
    reason = (
        f"{lifts}; the demand is {findings.demand}. In {fell} of "
        f"{base.trials:,} runs{that} at the demand it falls."
    )
    for widest in tornado(findings.cases, findings.answer.basis)[:1]:
        if ends := bar_words(widest):
            name = parameter_words(widest["parameter"])
            reason += f" What matters most is the {name}: over its range {ends} fall"
            if about := as_described(widest, findings.answer.value):
                reason += f" by the runs about the demand{about}"
            reason += "."
    return reason
