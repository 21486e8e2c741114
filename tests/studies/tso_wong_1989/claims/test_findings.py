"""Findings: the verdict on a statement follows from its outcome."""

from rocksteady.studies.tso_wong_1989.claims.findings import Finding, Verdict


def test_a_verdict_follows_from_the_outcome_alone() -> None:
    verdicts = [Finding(holds=holds, detail="").verdict for holds in (True, False, None)]
    assert verdicts == [Verdict.REPRODUCED, Verdict.CORRECTED, Verdict.NOT_CHECKABLE]
    assert [verdict.value for verdict in Verdict] == ["reproduced", "corrected", "not-checkable"]
