"""Scores over sizes of training sets."""

import pytest

from tests.risk.calibration.cases import narrow


def test_few_groups_predict_worse_than_many() -> None:
    rows = narrow().validation.learning
    assert [row["groups"] for row in rows] == [1, 2, 4, 8]
    tests = [row["tests"] for row in rows]
    assert tests == pytest.approx([4.0, 8.0, 16.0, 32.0], rel=0.01)  # 60 tests on 15 records
    block = [row["block brier"] for row in rows]
    assert block[-1] < 0.9 * block[0]
    assert block[0] < rows[0]["base rate brier"]
