"""Laboratories: what they are made of."""

import numpy as np
import pytest

from tests.records import FOLDER
from tests.risk.calibration.laboratories import SESSION_GAIN, make_laboratory

pytestmark = pytest.mark.skipif(not FOLDER.exists(), reason="there is no ../shared/records")


@pytest.mark.slow
def test_sessions_share_their_gain_and_levels_decide_outcomes() -> None:
    made = [make_laboratory(seed, tests=140) for seed in range(8)]
    gains = np.array([list(each.session_gain.values()) for each in made])
    assert gains.std() == pytest.approx(SESSION_GAIN, rel=0.2)
    assert all(0.1 < each.tests.fell.mean() < 0.6 for each in made)
    assert {len(each.tests) for each in made} == {140}
