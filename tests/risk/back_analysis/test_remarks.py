"""Remarks on a back-analysis: each from its own limit on, and none before."""

from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from rocksteady.calibration import BackAnalysis, ScanOptions
from rocksteady.risk.back_analysis._analysis import analyse
from rocksteady.risk.back_analysis._remarks import remarks_on
from tests.every import every
from tests.risk.back_analysis.test_analysis import ERRORS, FELL
from tests.risk.back_analysis.toys import toy_survey, toy_tried

COUNT = 40
RATIOS = np.exp(np.linspace(-0.6, 0.9, COUNT))
AT_ONE = np.stack([np.full(COUNT, 0.4), 0.4 * RATIOS], axis=1)
THRESHOLDS = np.repeat(np.linspace(0.15, 0.9, 9)[:, np.newaxis], COUNT, axis=1)


@pytest.fixture(scope="module", name="clean")
def _clean() -> BackAnalysis:
    tried = toy_tried(THRESHOLDS, AT_ONE, ERRORS, limits=(0.02, 5.0))
    found = analyse(toy_survey(FELL), tried, ERRORS, ScanOptions(temper=1.0, trials=0))
    return replace(found, held_out_surveys=12, mc_errors=np.array([0.0, np.nan]))


def changed(clean: BackAnalysis, **keys: Any) -> str:
    return " ".join(remarks_on(replace(clean, **keys)))


def moved(clean: BackAnalysis, places: Any, share: float) -> np.ndarray:
    """Return weights of which some records or nodes have a share."""
    weights = clean.weights.copy()
    inside = np.zeros(weights.shape, dtype=bool)
    inside[places] = True
    weights[inside] = share / inside.sum()
    weights[~inside] = (1.0 - share) / (~inside).sum()
    return weights


def test_a_clean_result_has_none(clean: BackAnalysis) -> None:
    assert remarks_on(clean) == ()


@every(
    ("keys", "words"),
    [
        ({"effective_records": 2.99}, "2.99 records carry the result"),
        ({"mc_errors": np.array([0.051, 0.0])}, "Monte Carlo error of the result is 5.1 %"),
        ({"mc_errors": np.array([0.0, 0.07])}, "Monte Carlo error of the result is 7 %"),
        ({"held_out_surveys": 0}, "No record was left out"),
    ],
)
def test_what_is_doubtful_is_remarked_on(
    clean: BackAnalysis, keys: dict[str, Any], words: str
) -> None:
    assert words in changed(clean, **keys)
    assert len(remarks_on(replace(clean, **keys))) == 1


def test_limits_of_doubt_are_not_doubtful_themselves(clean: BackAnalysis) -> None:
    assert not changed(clean, effective_records=3.0)
    assert not changed(clean, mc_errors=np.array([0.05, 0.05]))
    for count, few in ((19, True), (20, False)):
        words = changed(clean, records=clean.records[:count])
        assert (f"{count} records: fewer than 20" in words) is few


@every(("end", "share", "near"), [("lower", 0.051, True), ("upper", 0.051, True),
                                  ("lower", 0.049, False), ("upper", 0.049, False)])  # fmt: skip
def test_a_twentieth_of_the_nodes_at_an_end_is_near_a_limit(
    clean: BackAnalysis, end: str, share: float, near: bool
) -> None:
    count = clean.weights.shape[1] // 20
    assert count >= 2
    place = slice(0, count) if end == "lower" else slice(-count, None)
    words = changed(clean, weights=moved(clean, (slice(None), place), share))
    other = "upper" if end == "lower" else "lower"
    assert (f"reaches the {end} limit of PGA" in words) is near
    assert f"the {other} limit" not in words
    # With a bound on one side the posterior reaches a limit by itself.
    one = replace(clean, bound="upper bound", weights=moved(clean, (slice(None), place), share))
    assert "limit of PGA" not in " ".join(remarks_on(one))


@every(("word", "share", "said"), [("lowest", 0.51, True), ("highest", 0.51, True),
                                   ("lowest", 0.49, False), ("highest", 0.49, False)])  # fmt: skip
def test_a_tenth_of_the_records_that_carries_half_is_remarked_on(
    clean: BackAnalysis, word: str, share: float, said: bool
) -> None:
    places = slice(0, 4) if word == "lowest" else slice(-4, None)
    middle = slice(clean.weights.shape[1] // 4, -clean.weights.shape[1] // 4)
    weights = np.zeros_like(clean.weights)
    weights[:, middle] = moved(clean, (places,), share)[:, middle]
    words = changed(clean, weights=weights / weights.sum())
    assert (f"Records of the {word} PGV/PGA carry more than half" in words) is said
    assert words.count("carry more than half") == int(said)
