"""Posteriors: areas of one, the interval of the table, the outline of the ruler."""

from dataclasses import replace

import numpy as np
import pytest
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import StepPatch

from rocksteady import plots
from rocksteady.errors import InputError
from rocksteady.show.style.tokens import inks_of
from tests.show.calibrated import calibrated


def drawn(parameter: str = "alpha_rad") -> Axes:
    return plots.posterior(calibrated(), Figure().add_subplot(), parameter=parameter)


def test_both_densities_have_the_area_of_one_and_the_mean_of_their_draws() -> None:
    (posterior,) = calibrated().posteriors.values()
    steps = {
        each.get_label(): each.get_data() for each in drawn().patches if isinstance(each, StepPatch)
    }
    values = posterior.of("alpha_rad")
    for label, weights in (
        ("after the tests", posterior.weights),
        ("before them", posterior.prior_weights),
    ):
        heights, edges, _ = steps[label]
        width = np.diff(edges)
        assert (heights * width).sum() == pytest.approx(1.0)
        mean = (heights * width * 0.5 * (edges[1:] + edges[:-1])).sum()
        assert mean == pytest.approx(weights @ values, abs=width.max())


def test_the_interval_and_the_outline_are_those_of_the_table() -> None:
    few = next(each for each in calibrated().parameters if each["parameter"] == "alpha_rad")
    assert few["low"] is None  # of too few draws
    key = drawn().get_legend()
    assert key is not None
    assert "not identified" in [text.get_text() for text in key.get_texts()]
    row = {**few, "median": 0.24, "low": 0.21, "high": 0.26}
    known = replace(calibrated(), parameters=(row,))
    axes = plots.posterior(known, Figure().add_subplot())
    lines = {str(each.get_label()): np.asarray(each.get_xdata()) for each in axes.lines}
    interval = next(x for label, x in lines.items() if label.startswith("90"))
    assert interval.tolist() == [row["low"], row["high"]]
    (outline,) = axes.texts
    assert (outline.get_text(), outline.xy[0]) == ("alpha of the outline", row["outline"])  # type: ignore[attr-defined]
    (limit,) = [line for line in axes.lines if line.get_color() == inks_of(axes).limit]
    assert limit.get_linestyle() == "--"
    assert np.asarray(limit.get_xdata()).tolist() == [row["outline"]] * 2
    assert not drawn("p_rad_s").texts


def test_what_is_not_there_is_refused() -> None:
    with pytest.raises(InputError, match="parameter = 'alfa' is not valid: the parameters are"):
        drawn("alfa")
    with pytest.raises(InputError, match="parameter = 'sigma_ln' is not valid"):
        drawn("sigma_ln")  # errors are integrated: there are no draws
    with pytest.raises(InputError, match="object = 'vase' is not valid: the objects are"):
        plots.posterior(calibrated(), Figure().add_subplot(), object="vase")
