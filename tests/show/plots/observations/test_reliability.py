"""Reliability: points are counts of tests, held out."""

import numpy as np
import pytest
from matplotlib.figure import Figure
from matplotlib.patches import Rectangle

from rocksteady import plots
from rocksteady.errors import InputError
from tests.show.calibrated import calibrated, unscored


def test_points_are_shares_of_tests_by_tenths() -> None:
    found = calibrated()
    axes = plots.reliability(found, Figure().add_subplot())
    p, fell = found.validation.predictions.p, found.tests.fell
    tenth = np.minimum((10.0 * p).astype(int), 9)
    expected = [(p[tenth == k].mean(), fell[tenth == k].mean()) for k in np.unique(tenth)]
    (points,) = (each for each in axes.lines if each.get_marker() == "o")
    assert np.column_stack(points.get_data()) == pytest.approx(np.array(expected))
    *numbers, diagonal = (text.get_text() for text in axes.texts)
    assert diagonal == "as predicted"
    counts = [int(text) for text in numbers]
    assert counts == np.unique(tenth, return_counts=True)[1].tolist()
    heights = [bar.get_height() for bar in axes.patches if isinstance(bar, Rectangle)]
    assert np.array(heights) / max(heights) == pytest.approx(np.array(counts) / max(counts))


def test_without_scores_there_is_no_picture() -> None:
    with pytest.raises(InputError, match="calibration has no held-out scores"):
        plots.reliability(unscored(), Figure().add_subplot())
