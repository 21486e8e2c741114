"""Scores over the groups learnt from."""

import numpy as np
import pytest
from matplotlib.figure import Figure

from rocksteady import plots
from rocksteady.errors import InputError
from tests.show.calibrated import calibrated, unscored


def test_the_block_stands_beside_the_logistic_and_the_base_rate() -> None:
    curve = calibrated().validation.learning
    axes = plots.learning(calibrated(), Figure().add_subplot(), score="brier")
    drawn = {str(each.get_label()): np.asarray(each.get_ydata()).tolist() for each in axes.lines}
    assert drawn == {
        "calibrated block": [row["block brier"] for row in curve],
        "logistic on intensity": [row["logistic brier"] for row in curve],
        "base rate": [row["base rate brier"] for row in curve],
    }
    last = curve[-1]["base rate brier"]
    (name,) = [text for text in axes.texts if text.get_text().startswith("base")]
    height = axes.transAxes.transform(name.xy)[1]  # type: ignore[attr-defined]
    assert axes.transData.inverted().transform((0.0, height))[1] >= last - 1e-9


def test_refusals() -> None:
    with pytest.raises(InputError, match="score = 'auc' is not valid: the scores are accuracy"):
        plots.learning(calibrated(), Figure().add_subplot(), score="auc")
    with pytest.raises(InputError, match="has no held-out scores"):
        plots.learning(unscored(), Figure().add_subplot())
