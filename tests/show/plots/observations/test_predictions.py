"""Predictions: a row for each test, in the order of its probability."""

from dataclasses import replace
from typing import Any

import numpy as np
from matplotlib.figure import Figure

from rocksteady import plots
from tests.show.calibrated import calibrated


def test_rows_are_in_the_order_of_their_probability() -> None:
    found = calibrated().validation.predictions
    unknown = replace(found, fell=(None, *found.fell[1:]))
    axes = plots.predictions(unknown, Figure().add_subplot())
    order = np.argsort(found.p, kind="stable")
    names = [text.get_text() for text in axes.get_yticklabels()]
    assert names == [found.test[place] for place in order]
    drawn = {
        int(y): x
        for line in axes.lines
        if str(line.get_label()) in ("fell", "stood", "predicted")
        for x, y in np.column_stack(line.get_data()).tolist()
    }
    assert [drawn[row] for row in range(len(order))] == found.p[order].tolist()
    (one,) = (line for line in axes.lines if line.get_label() == "predicted")
    assert np.asarray(one.get_xdata()).tolist() == [found.p[0]]


def test_many_tests_have_no_names() -> None:
    found = calibrated().validation.predictions
    double: dict[str, Any] = {
        key: np.tile(value, 2) if isinstance(value, np.ndarray) else tuple(value) * 2
        for key, value in vars(found).items()
        if key != "warnings"
    }
    twice = replace(found, **double)
    axes = plots.predictions(twice, Figure().add_subplot())
    assert axes.get_ylabel() == "tests in the order of their probability"
