"""Bars of runs: their lengths are d/d0, and a run beyond d0 ends in an arrow."""

import numpy as np
import pytest
from matplotlib.figure import Figure

from rocksteady.facades.checks.facade_runs import FacadeRuns
from rocksteady.facades.plots.run_displacements import EDGE, plot_facade_runs
from tests.facades.page.checked_facades import thin, tied


def runs_of(name: str) -> FacadeRuns:
    runs = {"thin": thin, "tied": tied}[name]().runs
    assert isinstance(runs, FacadeRuns)
    return runs


@pytest.mark.parametrize("name", ["thin", "tied"])
def test_every_bar_is_as_long_as_its_run(name: str) -> None:
    runs = runs_of(name)
    axes = plot_facade_runs(runs, Figure().add_subplot())
    count = len(runs.records)
    for sign in range(2):
        widths = [bar.get_width() for bar in axes.containers[sign]]
        expected = [EDGE if share > 1.0 else share for share in runs.share[:, sign]]
        assert widths == pytest.approx(expected)
        assert len(widths) == count
    names = [label.get_text() for label in axes.get_yticklabels()]
    assert names == list(runs.records)


def test_runs_beyond_d0_have_an_arrow_each_and_no_mean() -> None:
    runs = runs_of("thin")
    axes = plot_facade_runs(runs, Figure().add_subplot())
    arrows = sum(
        len(np.asarray(line.get_xdata())) for line in axes.lines if line.get_marker() == ">"
    )
    assert arrows == int((runs.share > 1.0).sum()) >= 1
    assert not [line for line in axes.lines if "mean" in str(line.get_label())]


def test_the_mean_is_over_records_of_the_larger_sign() -> None:
    runs = runs_of("tied")
    axes = plot_facade_runs(runs, Figure().add_subplot(), language="it")
    (mean,) = (line for line in axes.lines if "media" in str(line.get_label()))
    expected = np.maximum(runs.share[:, 0], runs.share[:, 1]).mean()
    assert float(np.asarray(mean.get_xdata())[0]) == pytest.approx(expected)
    assert f"{expected:.3g}".replace(".", ",") in str(mean.get_label())
