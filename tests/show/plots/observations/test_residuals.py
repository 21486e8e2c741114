"""Residuals: falls less the sum of probabilities, the largest misfit on top."""

import numpy as np
import pytest
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from rocksteady import plots
from rocksteady.errors import InputError
from tests.show.calibrated import calibrated


def points(axes: Axes) -> dict[int, float]:
    return {
        round(y): x
        for line in axes.lines
        if line.get_marker() == "o"
        for x, y in np.column_stack(line.get_data()).tolist()
    }


@pytest.mark.parametrize("by", ["record", "session"])
def test_residuals_are_falls_less_those_predicted(by: str) -> None:
    found = calibrated()
    axes = plots.residuals(found, Figure().add_subplot(), by=by)
    p, fell = found.validation.predictions.p, found.tests.fell
    names = np.array(
        [test.record.name if by == "record" else test.session for test in found.tests.tests]
    )
    drawn, over = points(axes), []
    for row, label in enumerate(axes.get_yticklabels()):
        own = names == label.get_text().rpartition(" (")[0]
        residual = float((fell - p)[own].sum())
        assert drawn[row] == pytest.approx(residual)
        assert label.get_text().endswith(f" ({own.sum()})")
        over.append(abs(residual) / np.sqrt((p * (1.0 - p))[own].sum()))
    assert over == sorted(over, reverse=True)
    assert len(over) == len(set(names))


def test_there_are_two_groupings() -> None:
    with pytest.raises(InputError, match="by = 'day' is not valid"):
        plots.residuals(calibrated(), Figure().add_subplot(), by="day")
