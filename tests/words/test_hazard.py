"""Words of hazard: rates, and what does not follow from a standing object."""

import dataclasses

from rocksteady import compute_risk
from rocksteady.risk import check_hazard_branches
from rocksteady.words.hazard import rate_words
from tests.every import every
from tests.risk.hazard.test_balanced_rocks import BETA, MEDIAN, branch
from tests.risk.hazard.test_failure_risk import HAZARD


def test_the_text_says_what_does_not_follow() -> None:
    found = check_hazard_branches((MEDIAN, BETA), [branch(1e-3, name="b1"), branch(1e-9)], 2000.0)
    text = " ".join(found.summary().split())
    assert "No bound on PGA follows from one object" in text
    assert "stands for 2000 years rejects 1 of 2 branches at 95 %" in text
    rows = found.to_dict()["branches"]
    assert [row["branch"] for row in rows] == ["b1", "2"]
    assert [row["rejected"] for row in rows] == [True, False]


@every(
    ("rate", "band", "words"),
    [
        (1.036e-3, (0.88e-3, 1.16e-3), "once in 965 years (90 %: 862 to 1,140): 5.0 % in 50 years"),
        (0.5, None, "once in 2 years: > 99 % in 50 years"),
        (1e-8, None, "once in 100,000,000 years: < 0.1 % in 50 years"),
    ],
)
def test_a_rate_in_words(rate: float, band: tuple[float, float] | None, words: str) -> None:
    risk = compute_risk((0.4, 0.5), HAZARD)
    assert rate_words(dataclasses.replace(risk, annual_rate=rate, band=band)) == words
