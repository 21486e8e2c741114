"""Scores over the temper and over the groups learnt from."""

from collections.abc import Callable

import numpy as np
import pytest
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from rocksteady import plots
from rocksteady.errors import InputError
from tests.show.calibrated import calibrated, unscored


def test_the_chosen_temper_and_the_untempered_are_marked_on_the_curve() -> None:
    found = calibrated()
    axes = plots.temper(found, Figure().add_subplot(), score="brier")
    curve = next(each for each in axes.lines if each.get_marker() == "o")
    x, y = (np.asarray(values) for values in curve.get_data())
    assert x.tolist() == sorted(found.temper_scores)
    assert y.tolist() == [found.temper_scores[t].brier[0] for t in x.tolist()]
    marks = {
        str(each.get_label()): [float(np.asarray(values)[0]) for values in each.get_data()]
        for each in axes.lines
        if each.get_marker() == "D"
    }
    assert marks["untempered"] == [1.0, found.temper_scores[1.0].brier[0]]
    assert marks[f"chosen, T = {found.temper:g}"][0] == found.temper


def test_the_block_stands_beside_the_logistic_and_the_base_rate() -> None:
    curve = calibrated().validation.learning
    axes = plots.learning(calibrated(), Figure().add_subplot(), score="brier")
    drawn = {str(each.get_label()): np.asarray(each.get_ydata()).tolist() for each in axes.lines}
    assert drawn == {
        "calibrated block": [row["calibrated"].brier[0] for row in curve],
        "logistic on intensity": [row["logistic"].brier[0] for row in curve],
        "base rate": [row["base rate"].brier[0] for row in curve],
    }
    last = curve[-1]["base rate"].brier[0]
    (name,) = [text for text in axes.texts if text.get_text().startswith("base")]
    height = axes.transAxes.transform(name.xy)[1]  # type: ignore[attr-defined]
    assert axes.transData.inverted().transform((0.0, height))[1] >= last - 1e-9


@pytest.mark.parametrize("plot", [plots.temper, plots.learning])
def test_refusals(plot: Callable[..., Axes]) -> None:
    with pytest.raises(InputError, match="score = 'auc' is not valid: the scores are accuracy"):
        plot(calibrated(), Figure().add_subplot(), score="auc")
    with pytest.raises(InputError, match="has no held-out scores"):
        plot(unscored(), Figure().add_subplot())
