"""Predictions: the highest probability first; an interval that does not exist is null."""

import math

import numpy as np

from rocksteady.risk.calibration.held_out.predictions import Predictions


def predictions(*p: float, effective: float = 100.0) -> Predictions:
    """Return predictions of some tests."""
    names = tuple(f"test {place}" for place in range(len(p)))
    at = np.array(p)
    known = effective >= 50.0
    return Predictions(
        test=names,
        object=("column",) * len(p),
        group=names,
        p=at,
        low=0.9 * at if known else np.full(len(p), np.nan),
        high=np.minimum(1.0, 1.1 * at) if known else np.full(len(p), np.nan),
        mc_error=np.full(len(p), 0.001),
        effective_draws=np.full(len(p), effective),
        held_out=(False,) * len(p),
        fell=(None,) * len(p),
    )


def test_one_test_is_a_sentence_with_its_interval() -> None:
    text = predictions(0.39).summary()
    assert text == "It falls in test 0 with 39 % (90 %: 35 to 43 %)."


def test_of_tests_the_likeliest_to_fall_come_first_and_those_left_out_are_counted() -> None:
    lines = predictions(0.02, 0.98, 0.4, 0.6, 0.1, 0.3, 0.2).summary().splitlines()
    assert lines[0] == "2 of 7 tests more likely fall than not."
    assert [line.split()[1] for line in lines[1:5]] == ["1", "3", "2", "5"]
    assert "3 more with --more: 0 likely to fall, 3 to stand" in lines[5]


def test_one_test_falls_and_two_fall() -> None:
    words = [predictions(*p).summary().splitlines()[0] for p in ((0.9, 0.2), (0.1, 0.2))]
    assert words == [
        "1 of 2 tests more likely falls than not.",
        "None of 2 tests more likely fall than not.",
    ]


def test_too_few_draws_are_no_answer() -> None:
    lines = predictions(0.39, effective=12.0).summary().splitlines()
    assert lines[0] == "No answer yet, provisional: 12 effective draws (at least 50 needed)."
    assert "39 %" in lines[1]


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
