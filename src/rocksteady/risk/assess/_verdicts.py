"""Verdict, colour, sentence and reason of an assessment."""

from dataclasses import dataclass
from typing import NamedTuple

from rocksteady.results.numbers import number, percent, quantity
from rocksteady.risk.assess._demand_level import DemandLevel
from rocksteady.risk.assess._remedies import Remedy
from rocksteady.risk.assess._sensitivity import Case, parameter_words, tornado
from rocksteady.risk.assess.described.facts import ObjectFacts
from rocksteady.risk.assess.two_numbers import share_words

AMBER = 0.2
"""Share of the target probability up to which an object is green; up to the target it is amber."""

WORDS = {"green": "low", "amber": "raised", "red": "high", "grey": "no answer"}
"""What a colour stands for, for those who do not see it."""


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
    pga_g, motion
        Its PGA, and what that begins; None without.
    friction_needed
        To rock without sliding at it; None without a PGA.
    target
        Probability that is accepted.
    probability, cases
        Probability of falling at the demand, and cases with one thing changed; none where it
        slides.
    fitted
        Whether that is of a curve, and not the share of the runs.
    remedy
        That of the least change, where one is needed.
    """

    facts: ObjectFacts
    level: DemandLevel
    demand: str
    pga_g: float | None
    motion: str | None
    friction_needed: float | None
    target: float
    probability: float | None = None
    cases: tuple[Case, ...] = ()
    fitted: bool = True
    remedy: Remedy | None = None


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
    pga = findings.pga_g or 0.0
    lifts = f"It lifts at {quantity(facts.uplift_pga_g, 'g')}"
    if findings.motion in ("slides", "slides and rocks"):
        low = facts.friction[0] if facts.friction else 0.0
        need = findings.friction_needed or 0.0
        return Answer(
            "slides",
            "grey",
            f"{facts.name} slides at a PGA of {quantity(pga, 'g')}: rocking is no answer, and no "
            "probability of falling is given.",
            f"Rocking alone needs a coefficient of friction of {number(need)}; the lowest given is "
            f"{number(low)}. Analyse the sliding, leave room for it, or measure a higher "
            "friction.",
        )
    if findings.motion == "rest":
        return Answer(
            "stands",
            "green",
            f"{facts.name} stays where it stands: a PGA of {quantity(pga, 'g')} does not lift it.",
            f"{lifts}. The fragility curve is of motions scaled to the demand's intensity, some of "
            "which have a higher PGA.",
        )
    probability = findings.probability or 0.0
    verdict = "above target" if probability > target else "below target"
    side = "more than" if probability > target else "within"
    share = f"{share_words(probability)} objects of this shape and size would fall"
    if not findings.fitted:  # a share is no smaller than one of the runs
        base = findings.cases[0]
        share = f"{base.fell or 'None'} of its {base.trials} runs fall"
    sentence = (
        f"{share} at {_article(findings.level.words)} ({percent(probability)}): {side} the target "
        f"of {number(100.0 * target)} %."
    )
    if remedy is not None:
        sentence = f"{sentence[:-1]}; the least change that meets the target is to {remedy.words}."
    return Answer(verdict, colour_of(probability, target), sentence, _reason(findings, lifts))


def _article(words: str) -> str:
    """Return words with the indefinite article before them, as "an Sa(1 s) of 0.3 g"."""
    return f"{'an' if words.startswith('Sa') else 'a'} {words}"


def _reason(findings: Findings, lifts: str) -> str:
    """Return why: uplift, the median, and what matters most."""
    base = findings.cases[0]
    reason = (
        f"{lifts}; the demand is {findings.demand}. In {base.fell} of {base.trials} runs at the "
        "demand it falls."
    )
    bars = tornado(findings.cases)
    if bars:
        widest = bars[0]
        reason += (
            f" What matters most is the {parameter_words(widest['parameter'])}: it moves the "
            f"probability between {percent(widest['low'])} and {percent(widest['high'])}."
        )
    return reason
