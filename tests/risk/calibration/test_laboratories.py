"""Laboratories: what they are made of."""

from dataclasses import replace

import numpy as np
import pytest

from tests.records import ABSENT, FOLDER
from tests.risk.calibration.laboratories import (
    SESSION_GAIN,
    covered,
    fit,
    make_laboratory,
)

pytestmark = pytest.mark.skipif(not FOLDER.exists(), reason=ABSENT)


@pytest.mark.slow
def test_sessions_share_their_gain_and_levels_decide_outcomes() -> None:
    made = [make_laboratory(seed, tests=140) for seed in range(20)]
    gains = np.array([list(each.session_gain.values()) for each in made])
    assert gains.std() == pytest.approx(SESSION_GAIN, rel=0.2)
    assert all(0.1 < each.tests.fell.mean() < 0.6 for each in made)
    assert {len(each.tests) for each in made} == {140}


@pytest.mark.slow
def test_intervals_hold_what_is_true() -> None:
    """Of 20 laboratories that the default priors draw; 85 % less two standard errors."""
    found = [covered(seed, drawn=True) for seed in range(20)]
    for name, lists in ((key, [each[key] for each in found]) for key in found[0]):
        share = np.mean([one for each in lists for one in each])
        assert share > 0.85 - 2.0 * np.sqrt(0.9 * 0.1 / 20), name


@pytest.mark.slow
def test_sessions_make_held_out_predictions_better() -> None:
    """The same 140 tests of a laboratory with and without their sessions, and the rival."""
    tests = make_laboratory(1, tests=140).tests
    alone = [replace(test, session=None) for test in tests.tests]
    rows = fit(tests).validation.rows
    bare = fit(replace(tests, tests=alone)).validation.rows
    assert rows["calibrated"].brier[0] < 0.75 * rows["logistic"].brier[0]
    assert bare["calibrated"].brier[0] - rows["calibrated"].brier[0] > 0.005
