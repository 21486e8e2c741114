"""The verdict on a count: what its evidence shows of a target."""

from dataclasses import dataclass, field
from typing import Final, Literal

from rocksteady.risk.counted.count import Count

Verdict = Literal["green", "red", "stands", "slides", "not-shown", "no-answer"]
VERDICTS: Final[tuple[Verdict, ...]] = (
    "red", "slides", "not-shown", "no-answer", "green", "stands",
)  # fmt: skip
"""All verdicts, those that call for action first."""
Reason = Literal[
    "", "few-records", "few-vertical", "too-far", "band", "cliff", "cliff-unjudged",
    "stretched", "built-in", "friction", "without-answer",
]  # fmt: skip
"""Why nothing is shown, or there is no answer; empty of another verdict."""
LEAST: Final = 11
"""Records below which a share is no answer."""
MARGIN: Final = 1.1
"""Multiple of the demand at which no more than the target may fall either."""
NEAR: Final = 2.0
"""Fold of a stretch of time below which a record is like the demand."""
DOUBTFUL, TOO_FAR = 10.0, 30.0
"""Median folds of records above which there is a doubt, and no answer."""
CODES: Final[dict[Verdict, int]] = {
    "green": 0, "stands": 0, "red": 1, "slides": 1, "not-shown": 3, "no-answer": 3,
}  # fmt: skip
"""Exit code of each verdict where it is checked; of a table the worst counts, 1 before 3."""


@dataclass(frozen=True, kw_only=True)
class Evidence:
    """What a verdict rests on.

    Attributes
    ----------
    target
        Share that is accepted.
    count, beyond, near
        Runs at the demand, at `MARGIN` times it, and at the demand of the records that are
        stretched less than `NEAR`-fold (None where none is stretched).
    stands, slides
        Whether statics says that nothing lifts it at the demand, or that its friction is too low.
    friction_known, built_in, for_vertical
        Whether its friction is given, no earthquake made the motions, and the demand has a vertical
        motion, which records without one cannot answer.
    fold
        Median fold of the records' scales or stretches, the larger.
    """

    target: float
    count: Count | None = None
    beyond: Count | None = None
    near: Count | None = None
    stands: bool = False
    slides: bool = False
    friction_known: bool = False
    built_in: bool = False
    for_vertical: bool = False
    fold: float = 1.0


@dataclass(frozen=True, kw_only=True)
class Decision:
    """Verdict and the reason of one that shows nothing.

    Attributes
    ----------
    verdict, reason
        Codes.
    doubts
        Codes of what limits the answer: "few-near" (under `LEAST` records are stretched less than
        `NEAR`-fold), "far" (a median fold above `DOUBTFUL`).
    """

    verdict: Verdict
    reason: Reason = ""
    doubts: tuple[Literal["few-near", "far"], ...] = field(default=())


def decide(evidence: Evidence) -> Decision:
    """Return the verdict that evidence allows.

    Green: the upper end of the band lies below the target, and no more than the target fall at
    `MARGIN` times the demand.  Red: its lower end lies above.  Neither holds against what runs
    without an answer could have been, or where records that are hardly stretched say otherwise.
    """
    if evidence.slides:
        return Decision(verdict="slides")
    if evidence.stands:
        return _standing(evidence)
    count, beyond = evidence.count, evidence.beyond
    if evidence.fold > TOO_FAR:
        return Decision(verdict="no-answer", reason="too-far")
    if count is None or count.records < LEAST:
        reason: Reason = "few-vertical" if evidence.for_vertical else "few-records"
        return Decision(verdict="no-answer", reason=reason)
    assert beyond is not None
    doubts: list[Literal["few-near", "far"]] = []
    if evidence.near is not None and evidence.near.records < LEAST:
        doubts.append("few-near")
    if evidence.fold > DOUBTFUL:
        doubts.append("far")
    verdict, reason = _judged(evidence, count, beyond)
    return Decision(verdict=verdict, reason=reason, doubts=tuple(doubts))


def _judged(evidence: Evidence, count: Count, beyond: Count) -> tuple[Verdict, Reason]:
    """Return verdict and reason of a count that is an answer."""
    target, near = evidence.target, evidence.near
    if near is not None and near.records < LEAST:
        near = None
    low, high = count.band
    verdict: Verdict = "red"
    doubts: list[tuple[Reason, bool]] = [
        ("stretched", near is not None and near.share <= target),
        ("without-answer", count.if_they_fell(fell=False).band[0] <= target),
    ]
    if low <= target:
        verdict = "green"
        doubts = [
            ("band", high >= target),
            ("cliff", beyond.share > target or beyond.records < LEAST),
            ("stretched", near is not None and near.share > min(target, high)),
            ("without-answer", count.if_they_fell(fell=True).band[1] >= target),
            ("built-in", evidence.built_in),
            ("friction", not evidence.friction_known),
        ]
    for reason, holds in doubts:
        if holds:
            return "not-shown", reason
    return verdict, ""


def _standing(evidence: Evidence) -> Decision:
    """Return the verdict on what nothing lifts at the demand; more may lift it."""
    beyond = evidence.beyond
    if beyond is None:
        return Decision(verdict="stands")
    if beyond.records < LEAST:
        return Decision(verdict="not-shown", reason="cliff-unjudged")
    if beyond.share > evidence.target:
        return Decision(verdict="not-shown", reason="cliff")
    return Decision(verdict="stands")
