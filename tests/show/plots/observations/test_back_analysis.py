"""Picture of a back-analysis: what it draws is what was found."""

import matplotlib.style
import numpy as np
import pytest
from matplotlib.figure import Figure

from rocksteady import plots
from rocksteady.calibration import BackAnalysis, ScanOptions
from rocksteady.risk.back_analysis._analysis import analyse
from tests.risk.back_analysis.test_analysis import AT_ONE, ERRORS, FELL, THRESHOLDS
from tests.risk.back_analysis.toys import toy_survey, toy_tried


def analysed(fell: list[bool]) -> BackAnalysis:
    tried = toy_tried(THRESHOLDS, AT_ONE, ERRORS, count=30)
    return analyse(toy_survey(fell), tried, ERRORS, ScanOptions(temper=1.0, trials=0))


def test_records_are_lines_of_their_ratio_and_the_medians_are_marked() -> None:
    found = analysed(FELL)
    axes = plots.back_analysis(found, Figure().add_subplot())
    assert (axes.get_xscale(), axes.get_yscale()) == ("log", "log")
    assert axes.get_title() == "3 of 9 fell"
    lines = [line for line in axes.lines if len(np.asarray(line.get_xdata())) > 1]
    assert len(lines) == 12
    ratios = sorted(
        float(np.asarray(line.get_ydata())[0] / np.asarray(line.get_xdata())[0]) for line in lines
    )
    assert ratios == pytest.approx(sorted(AT_ONE[:, 1] / AT_ONE[:, 0]))
    (middle,) = [line for line in axes.lines if len(np.asarray(line.get_xdata())) == 1]
    assert np.asarray(middle.get_xdata())[0] == found.medians[0]
    assert np.asarray(middle.get_ydata())[0] == found.medians[1]
    low, high = axes.get_xlim()
    inside = found.first_values[found.region.any(axis=1)]
    assert low <= inside.min()
    assert inside.max() <= high


@pytest.mark.parametrize("fell", [True, False])
def test_outcomes_of_one_kind_have_no_median(fell: bool) -> None:
    axes = plots.back_analysis(analysed([fell] * 9), Figure().add_subplot())
    assert all(len(np.asarray(line.get_xdata())) > 1 or np.isnan(line.get_xdata()).all()
               for line in axes.lines)  # fmt: skip
    legend = axes.get_legend()
    assert legend is not None
    words = [text.get_text() for text in legend.get_texts()]
    assert "chance above 0.1" in words
    assert "medians" not in words


def test_on_dark_paper_the_edge_is_light() -> None:
    found = analysed(FELL)
    plain = plots.back_analysis(found, Figure().add_subplot())
    with matplotlib.style.context("dark_background"):
        dark = found.plot(Figure().add_subplot())
    assert dark.lines[-1].get_markeredgecolor() != plain.lines[-1].get_markeredgecolor()
