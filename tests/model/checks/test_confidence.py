"""Wilson's interval of a share against SciPy's, and the confidence of every interval."""

import numpy as np
import pytest
from scipy.stats import binomtest

from rocksteady.model.checks.confidence import (
    CONFIDENCE_TEXT,
    share_interval,
)
from rocksteady.results.numbers import CONFIDENCE


def test_it_is_the_interval_of_scipy() -> None:
    for trials in (1, 7, 40, 10_000):
        hits = np.unique(np.linspace(0, trials, 9).astype(int))
        for confidence in (0.5, 0.9, 0.99):
            low, high = share_interval(hits / trials, trials, confidence)
            for k, *ends in zip(hits.tolist(), low, high, strict=True):
                known = binomtest(k, trials).proportion_ci(confidence, method="wilson")
                assert ends == pytest.approx([known.low, known.high], rel=1e-9, abs=1e-15)
    assert share_interval(0.0, 5)[0] == 0.0
    assert share_interval(1.0, 5)[1] == 1.0


def test_the_default_is_90_per_cent() -> None:
    assert (CONFIDENCE, CONFIDENCE_TEXT) == (0.9, "90 % interval")
