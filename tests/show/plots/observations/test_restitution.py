"""Plots of measured free rocking show the peaks, the fit and Housner's decay."""

import numpy as np
import pytest
from matplotlib.figure import Figure

from rocksteady import Block, fit_restitution, plots
from rocksteady.errors import InputError
from rocksteady.formulas import free_rocking_peaks
from rocksteady.histories import Release

BLOCK = Block.rectangle(width=0.05, height=0.5)
PEAKS = free_rocking_peaks(0.6, 0.95, 12, alpha=BLOCK.alpha)
UNLIKE = Block.asymmetric(left=0.15, right=0.25, height=1.2)


def test_the_fit_goes_through_exact_peaks_and_housners_decay_above_them() -> None:
    fit = fit_restitution(BLOCK.alpha * PEAKS, BLOCK)
    axes = plots.restitution(fit, Figure().add_subplot())
    measured, fitted, housner = (line.get_ydata() for line in axes.get_lines())
    assert measured == pytest.approx(PEAKS, rel=1e-12)
    assert fitted == pytest.approx(PEAKS, rel=1e-9)
    whole = free_rocking_peaks(0.6, BLOCK.restitution, 12, alpha=BLOCK.alpha)
    assert housner == pytest.approx(whole, rel=1e-9)


def test_peaks_of_one_side_stand_two_impacts_apart() -> None:
    fit = fit_restitution(Release(peaks_rad=BLOCK.alpha * PEAKS[::2], sides=1), BLOCK)
    axes = plots.restitution(fit, Figure().add_subplot())
    measured, fitted, _ = axes.get_lines()
    assert measured.get_xdata() == pytest.approx(np.arange(0, 13, 2))
    assert fitted.get_ydata() == pytest.approx(PEAKS[::2], rel=1e-9)


def test_the_panel_of_impacts_has_each_impact_and_both_values() -> None:
    fit = fit_restitution(BLOCK.alpha * PEAKS, BLOCK)
    axes = plots.restitution(fit, Figure().add_subplot(), panel="impacts")
    (points,) = axes.containers
    drawn = points[0].get_xydata().astype(float)  # objects in earlier matplotlib
    assert drawn[:, 1] == pytest.approx(np.full(12, 0.95), abs=1e-9)
    assert drawn[:, 0] == pytest.approx(PEAKS[:-1])
    assert {text.get_text() for text in axes.texts} == {"fit 0.95", "Housner 0.985"}


def test_unlike_sides_have_a_line_each() -> None:
    fit = fit_restitution([0.12, 0.16, 0.09, 0.13, 0.08, 0.11, 0.07], UNLIKE)
    axes = plots.restitution(fit, Figure().add_subplot(), panel="impacts")
    assert sum("from" in text.get_text() for text in axes.texts) == 4
    places = sorted(float(text.xy[1]) for text in axes.texts)  # type: ignore[attr-defined]
    assert min(np.diff(places)) > 0.0
    assert fit.plot().get_xlabel() == "impacts"


def test_another_panel_is_refused() -> None:
    fit = fit_restitution(BLOCK.alpha * PEAKS, BLOCK)
    with pytest.raises(InputError, match="there are two panels"):
        plots.restitution(fit, panel="decay")
