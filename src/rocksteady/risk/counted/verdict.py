"""The verdict on a count: what its evidence shows of a target."""

from dataclasses import dataclass, field
from typing import Final, Literal

from rocksteady.errors import InputError
from rocksteady.model.checks.arguments import checked
from rocksteady.model.checks.validation import in_range
from rocksteady.results.numbers import number
from rocksteady.risk.counted.count import Count

Verdict = Literal["green", "red", "stands", "slides", "not-shown", "no-answer"]
VERDICTS: Final[tuple[Verdict, ...]] = (
    "red", "slides", "not-shown", "no-answer", "green", "stands",
)  # fmt: skip
"""All verdicts, those that call for action first."""
Reason = Literal[
    "", "few-records", "few-vertical", "too-far", "band", "cliff", "cliff-unjudged",
    "stretched", "built-in", "friction", "without-answer", "rate-unknown", "rate-records",
    "far-off", "floor-spectrum", "odd-peak",
]  # fmt: skip
"""Why nothing is shown, or there is no answer; empty of another verdict."""
Unfit = Literal["", "far-off", "floor-spectrum", "odd-peak"]
"""Why motions on a spectrum are never green; empty of none."""
Doubt = Literal["few-near", "far", "", "far-off", "floor-spectrum", "odd-peak"]
"""What limits an answer."""
YEARS: Final = 50.0
"""Time of a probability beside a rate [years]."""
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


@checked
@dataclass(frozen=True)
class Target:
    """Share that is accepted, of runs at the demand or as a probability in 50 years.

    Parameters
    ----------
    share
        In (0, 1).
    years
        50 of a probability in 50 years; None (default) of runs at the demand.

    Raises
    ------
    InputError
        If one is outside its range.

    Examples
    --------
    >>> Target(0.1).words, Target(0.01, years=50).words
    ('10 %', '1 % in 50 years')
    """

    share: float
    years: float | None = None

    def __post_init__(self) -> None:
        """Validate."""
        share = in_range("target", self.share, 0.0, 1.0, "()", hint="give a share, as 0.1")
        object.__setattr__(self, "share", share)
        if self.years not in (None, YEARS):
            valid = f"a target is at the demand or in {YEARS:g} years"
            raise InputError("years", self.years, valid, "give 50, or leave it out")

    @property
    def words(self) -> str:
        """The target in words."""
        time = "" if self.years is None else f" in {number(self.years)} years"
        return f"{number(100.0 * self.share)} %{time}"


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
    unfit
        Why motions on its spectrum are never green; empty of none.
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
    unfit: Unfit = ""


@dataclass(frozen=True, kw_only=True)
class Decision:
    """Verdict and the reason of one that shows nothing.

    Attributes
    ----------
    verdict, reason
        Codes.
    doubts
        Codes of what limits the answer: "few-near" (under `LEAST` records are stretched less than
        `NEAR`-fold), "far" (a median fold above `DOUBTFUL`), and why motions on a spectrum are
        never green.
    """

    verdict: Verdict
    reason: Reason = ""
    doubts: tuple[Doubt, ...] = field(default=())


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
    doubts: list[Doubt] = [evidence.unfit] if evidence.unfit else []
    if evidence.near is not None and evidence.near.records < LEAST:
        doubts.append("few-near")
    if evidence.fold > DOUBTFUL:
        doubts.append("far")
    verdict, reason = _judged(evidence, count, beyond)
    return Decision(verdict=verdict, reason=reason, doubts=tuple(doubts))


@dataclass(frozen=True, kw_only=True)
class RateEvidence:
    """What a verdict on a probability in some years rests on.

    Attributes
    ----------
    target
        Probability that is accepted.
    band
        The 90 % interval of the probability; None of too few records.
    near
        Probability by the records that are stretched less than `NEAR`-fold; None of too few.
    is_known
        Whether no more than a tenth of the rate may lie above the runs or the hazard curve.
    friction_known, built_in, unfit
        As of `Evidence`.
    """

    target: float
    band: tuple[float, float] | None
    near: float | None
    is_known: bool
    friction_known: bool
    built_in: bool
    unfit: Unfit = ""


def decide_rate(evidence: RateEvidence) -> tuple[Verdict, Reason]:
    """Return verdict and reason of a probability in some years.

    Green: the upper end of its band lies below the target.  Red: its lower end lies above.
    """
    target, near = evidence.target, evidence.near
    if not evidence.is_known:
        return "not-shown", "rate-unknown"
    if evidence.band is None:
        return "not-shown", "rate-records"
    low, high = evidence.band
    if low > target:
        return _withdrawn("red", [("stretched", near is not None and near <= target)])
    return _withdrawn(
        "green",
        [
            ("band", high >= target),
            ("stretched", near is not None and near > target),
            (evidence.unfit, bool(evidence.unfit)),
            ("built-in", evidence.built_in),
            ("friction", not evidence.friction_known),
        ],
    )


def _withdrawn(verdict: Verdict, doubts: list[tuple[Reason, bool]]) -> tuple[Verdict, Reason]:
    """Return a verdict, or the first doubt that withdraws it."""
    reason = next((reason for reason, holds in doubts if holds), None)
    return (verdict, "") if reason is None else ("not-shown", reason)


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
            (evidence.unfit, bool(evidence.unfit)),
            ("built-in", evidence.built_in),
            ("friction", not evidence.friction_known),
        ]
    return _withdrawn(verdict, doubts)


def _standing(evidence: Evidence) -> Decision:
    """Return the verdict on what nothing lifts at the demand; more may lift it."""
    beyond = evidence.beyond
    if evidence.unfit == "odd-peak":  # statics takes the peak too
        return Decision(verdict="not-shown", reason="odd-peak", doubts=("odd-peak",))
    if beyond is None:
        return Decision(verdict="stands")
    if beyond.records < LEAST:
        return Decision(verdict="not-shown", reason="cliff-unjudged")
    if beyond.share > evidence.target:
        return Decision(verdict="not-shown", reason="cliff")
    return Decision(verdict="stands")
