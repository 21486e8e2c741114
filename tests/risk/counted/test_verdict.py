"""Verdicts: each reason, and over all evidence that there can be what green and red take."""

import itertools
import math
from dataclasses import replace
from typing import Any, get_args

import pytest

from rocksteady.errors import InputError
from rocksteady.risk.counted.count import Count
from rocksteady.risk.counted.verdict import (
    CODES,
    DOUBTFUL,
    LEAST,
    TOO_FAR,
    VERDICTS,
    Decision,
    Evidence,
    RateEvidence,
    Reason,
    Target,
    Verdict,
    decide,
    decide_rate,
)
from tests.every import every
from tests.risk.counted.recorded import count_of, spread_out

NONE = count_of([0] * 56)
FEW = count_of([0] * 10)
SOME = spread_out(31, 56)  # 11 %
QUARTER = count_of([5, 0, 0, 0] * 14)
ALL = count_of([5] * 56)
USUAL = Evidence(target=0.1, count=NONE, beyond=NONE, friction_known=True)


def without(fell: int, unanswered: int, records: int = 56) -> Count:
    """Return a count of which some records fall and of others no run has an answer."""
    tried = [0] * unanswered + [5] * (records - unanswered)
    falls = [0] * (records - fell) + [5] * fell
    return count_of(falls, 5, tried)


CASES: list[tuple[dict[str, Any], Verdict, Reason]] = [
    ({}, "green", ""),
    ({"beyond": QUARTER, "target": 0.25}, "green", ""),  # the target itself at 1.1 x
    ({"near": count_of([0] * 36)}, "green", ""),
    ({"fold": TOO_FAR}, "green", ""),
    ({"count": ALL, "beyond": ALL}, "red", ""),
    ({"count": ALL, "beyond": ALL, "friction_known": False}, "red", ""),
    ({"count": ALL, "beyond": ALL, "built_in": True}, "red", ""),
    ({"count": ALL, "beyond": NONE}, "red", ""),
    ({"slides": True}, "slides", ""),
    ({"slides": True, "stands": True, "count": None, "beyond": None}, "slides", ""),
    ({"stands": True, "count": None, "beyond": None}, "stands", ""),
    ({"stands": True, "count": None, "beyond": None, "friction_known": False}, "stands", ""),
    ({"stands": True}, "stands", ""),
    ({"stands": True, "beyond": SOME}, "not-shown", "cliff"),
    ({"stands": True, "beyond": SOME, "target": 0.12}, "stands", ""),
    ({"stands": True, "beyond": QUARTER, "target": 0.25}, "stands", ""),  # the target itself
    ({"stands": True, "count": FEW, "beyond": FEW}, "not-shown", "cliff-unjudged"),
    ({"count": FEW, "beyond": FEW}, "no-answer", "few-records"),
    ({"count": None, "beyond": None}, "no-answer", "few-records"),
    ({"count": FEW, "beyond": FEW, "for_vertical": True}, "no-answer", "few-vertical"),
    ({"count": without(0, 46)}, "no-answer", "few-records"),  # 10 of 56 have an answer
    ({"fold": 1.001 * TOO_FAR}, "no-answer", "too-far"),
    ({"count": SOME, "beyond": ALL}, "not-shown", "band"),
    ({"target": NONE.band[1]}, "not-shown", "band"),  # the upper end itself is not below it
    ({"target": 0.05}, "not-shown", "band"),  # 56 records show 5.2 % at best
    ({"beyond": spread_out(29, 56)}, "not-shown", "cliff"),
    ({"beyond": FEW}, "not-shown", "cliff"),
    ({"near": spread_out(15, 30)}, "not-shown", "stretched"),  # the target itself, above the band
    ({"near": spread_out(30, 36)}, "not-shown", "stretched"),
    ({"count": ALL, "beyond": ALL, "near": count_of([0] * 12)}, "not-shown", "stretched"),
    ({"built_in": True}, "not-shown", "built-in"),
    ({"built_in": True, "friction_known": False}, "not-shown", "built-in"),
    ({"friction_known": False}, "not-shown", "friction"),
    ({"unfit": "far-off"}, "not-shown", "far-off"),
    ({"unfit": "floor-spectrum", "built_in": True}, "not-shown", "floor-spectrum"),
    ({"unfit": "far-off", "count": ALL, "beyond": ALL}, "red", ""),
    ({"unfit": "odd-peak", "stands": True, "beyond": None}, "not-shown", "odd-peak"),
    ({"unfit": "far-off", "stands": True, "beyond": None}, "stands", ""),
    ({"count": without(0, 10)}, "not-shown", "without-answer"),
    ({"count": without(10, 40), "target": 0.2}, "not-shown", "without-answer"),
]  # fmt: skip


@every(("changes", "verdict", "reason"), CASES)
def test_evidence_has_its_verdict_and_its_reason(
    changes: dict[str, Any], verdict: Verdict, reason: Reason
) -> None:
    decision = decide(replace(USUAL, **changes))
    assert (decision.verdict, decision.reason) == (verdict, reason)


def test_every_verdict_and_every_reason_is_reached() -> None:
    assert {verdict for _, verdict, _ in CASES} == set(get_args(Verdict)) == set(VERDICTS)
    rates = {decide_rate(each)[1] for each in rate_evidence()}
    assert {reason for _, _, reason in CASES} | rates == set(get_args(Reason))
    assert len(VERDICTS) == len(CODES) == 6


def test_what_is_hardly_stretched_counts_from_as_many_records_on_as_an_answer_takes() -> None:
    for near, reason, doubts in (
        (spread_out(50, LEAST - 1), "", ("few-near",)),
        (spread_out(50, LEAST), "stretched", ()),
    ):
        found = decide(replace(USUAL, near=near))
        assert (found.reason, found.doubts) == (reason, doubts)
    red = replace(USUAL, count=ALL, beyond=ALL)
    assert decide(replace(red, near=count_of([0] * (LEAST - 1)))).verdict == "red"
    assert decide(replace(red, near=count_of([0] * LEAST))).verdict == "not-shown"
    # At the target itself, or below, red is withdrawn; above it, it is not.
    for falls, verdict in ((10, "not-shown"), (11, "red")):
        assert decide(replace(red, near=spread_out(falls, 20))).verdict == verdict


@every(
    ("fold", "verdict", "doubts"),
    [(1.0, "green", ()), (DOUBTFUL, "green", ()), (1.001 * DOUBTFUL, "green", ("far",)),
     (TOO_FAR, "green", ("far",)), (1.001 * TOO_FAR, "no-answer", ())],
)  # fmt: skip
def test_far_records_are_a_doubt_and_then_no_answer(
    fold: float, verdict: str, doubts: tuple[str, ...]
) -> None:
    found = decide(replace(USUAL, fold=fold))
    assert (found.verdict, found.doubts) == (verdict, doubts)


def test_both_doubts_are_named() -> None:
    found = decide(replace(USUAL, near=FEW, fold=2.0 * DOUBTFUL))
    assert found == Decision(verdict="green", doubts=("few-near", "far"))


COUNTS = [
    *(spread_out(falls, records)
      for records in (1, 10, 11, 28, 56) for falls in (0, 1, 3, 8, 31, 5 * records)),
    *(without(fell, lost) for fell, lost in ((0, 3), (0, 30), (8, 3), (0, 46), (26, 30))),
]  # fmt: skip


@pytest.mark.parametrize("target", [1e-3, 0.06, 0.1, 0.3])
def test_over_all_evidence_green_and_red_are_what_their_definitions_say(target: float) -> None:
    """The definitions as two conditions each, over counts, friction, motions and statics."""
    seen = set()
    for count, beyond, near, (slides, stands), (known, built_in), fold in itertools.product(
        COUNTS, COUNTS[::3], [None, FEW, NONE, SOME, spread_out(2, 11)],
        [(False, False), (False, True), (True, False)],
        [(True, False), (False, False), (True, True)], [1.0, 31.0],
    ):  # fmt: skip
        found = decide(
            Evidence(
                target=target, count=count, beyond=beyond, near=near, stands=stands, slides=slides,
                friction_known=known, built_in=built_in, fold=fold,
            )
        )  # fmt: skip
        seen.add(found.verdict)
        if slides:
            assert found == Decision(verdict="slides")
            continue
        if stands:
            safe = beyond.records >= LEAST and beyond.share <= target
            assert found.verdict == ("stands" if safe else "not-shown")
            continue
        assert (found.verdict == "no-answer") == (count.records < LEAST or fold > TOO_FAR)
        low, high = count.band
        worst, best = (count.if_they_fell(fell=fell).band for fell in (True, False))
        like = near if near is not None and near.records >= LEAST else None
        evidence = found.verdict != "no-answer"
        green = (
            evidence
            and max(high, worst[1] if count.without else 0.0) < target
            and beyond.records >= LEAST
            and beyond.share <= target
            and (like is None or like.share <= min(target, high))
            and known
            and not built_in
        )
        red = (
            evidence
            and min(low, best[0] if count.without else 1.0) > target
            and (like is None or like.share > target)
        )
        assert (found.verdict == "green") == green
        assert (found.verdict == "red") == red
        assert (found.reason == "") == (green or red)
    assert seen >= {"slides", "stands", "no-answer", "not-shown"}
    assert ("green" in seen) == (target > 0.052)
    assert "red" in seen


def rate_evidence(target: float = 0.02) -> list[RateEvidence]:
    """Return all evidence on a probability in some years that ends beside a target make."""
    ends = [0.5 * target, target, 2.0 * target]
    bands = [None, *itertools.combinations_with_replacement(ends, 2)]
    doubts = itertools.product([True, False], repeat=4)
    return [
        RateEvidence(
            target=target, band=band, near=near, is_known=known, friction_known=friction,
            built_in=built_in, unfit="far-off" if unfit else "",
        )
        for band, near, (known, friction, built_in, unfit) in itertools.product(
            bands, [None, *ends], [*doubts]
        )
    ]  # fmt: skip


def test_over_all_rates_green_and_red_are_what_their_definitions_say() -> None:
    for each in rate_evidence():
        verdict, reason = decide_rate(each)
        low, high = each.band or (0.0, 1.0)  # of too few records nothing is shown
        near = [] if each.near is None else [each.near]
        safe = [high < each.target, *(value <= each.target for value in near)]
        sure = each.friction_known and not each.built_in and not each.unfit
        green = all(safe) and each.is_known and sure
        red = min([low, *near]) > each.target and each.is_known
        assert verdict == ("green" if green else "red" if red else "not-shown")
        assert (reason == "") == (green or red)
        assert (reason == "rate-unknown") == (not each.is_known)
        assert (reason == "rate-records") == (each.is_known and each.band is None)


def test_a_target_is_a_share_and_may_have_a_time() -> None:
    assert (Target(0.1).words, Target(0.01, years=50).words) == ("10 %", "1 % in 50 years")
    assert Target(0.1) != Target(0.1, years=50.0) == Target(0.1, years=50)
    for share, years in ((0.0, None), (1.0, None), (math.nan, 50.0), (0.1, 0.0), (0.1, -50.0)):
        with pytest.raises(InputError, match=r"target = |years = "):
            Target(share, years)
