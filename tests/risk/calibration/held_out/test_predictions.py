"""Rows of predictions: an interval that does not exist is null, never a number."""

import math

import numpy as np

from rocksteady.risk.calibration.held_out.predictions import Predictions


def predicted(low: float, high: float) -> Predictions:
    """Return the prediction of one test."""
    return Predictions(
        test=("t1",),
        object=("vase",),
        group=("g",),
        p=np.array([0.4]),
        low=np.array([low]),
        high=np.array([high]),
        mc_error=np.array([0.01]),
        effective_draws=np.array([30.0]),
        held_out=(True,),
        fell=(None,),
    )


def test_bounds_are_the_numbers_and_null_where_there_are_none() -> None:
    (row,) = predicted(0.3, 0.5).rows
    assert (row["low"], row["high"], row["outcome"]) == (0.3, 0.5, "unknown")
    for low, high in ((math.nan, 0.5), (0.3, math.nan)):
        (row,) = predicted(low, high).rows
        assert row["low"] == (None if math.isnan(low) else low)
        assert row["high"] == (None if math.isnan(high) else high)
