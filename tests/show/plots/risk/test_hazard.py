"""Pictures of risk: what is drawn is what was computed, on light and on dark paper."""

import numpy as np
import pytest
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from scipy.special import ndtr

from rocksteady import compute_risk, plots
from rocksteady.risk import HazardCurve, Risk

LEVELS = np.geomspace(0.02, 2.0, 9)
HAZARD = HazardCurve(measure="pgv_m_s", levels=LEVELS, rates=3e-4 * LEVELS**-2.0)


def risk() -> Risk:
    return compute_risk((0.4653, 0.592), HAZARD, measure="pgv_m_s")


def drawn() -> tuple[Axes, Axes]:
    axes = plots.risk(risk(), Figure().add_subplot())
    figure = axes.get_figure()
    assert figure is not None
    (beside,) = (each for each in figure.axes if each is not axes)
    return axes, beside


def test_hazard_and_fragility_are_those_of_the_risk() -> None:
    axes, beside = drawn()
    x, y = (np.asarray(values) for values in axes.lines[0].get_data())
    assert (x.tolist(), y.tolist()) == (HAZARD.levels.tolist(), HAZARD.rates.tolist())
    x, y = (np.asarray(values) for values in beside.lines[0].get_data())
    assert y == pytest.approx(ndtr(np.log(x / 0.4653) / 0.592), abs=1e-12)
    assert (axes.get_xlabel(), axes.get_xscale()) == ("PGV [m/s]", "log")
    assert beside.get_ylim() == pytest.approx((0.0, 1.03))
    assert beside.get_yticks().tolist() == [0.0, 0.25, 0.5, 0.75, 1.0]
    for each in (axes, beside):
        assert each.yaxis.label.get_color() == each.lines[0].get_color()
    assert axes.get_title("center") + axes.get_title("left") == (
        f"falls once in {float(f'{1.0 / risk().annual_rate:.3g}'):,.0f} years"
    )


def test_bars_are_highest_where_the_risk_is() -> None:
    """Under a power law the risk has its largest density at median exp(-k beta^2)... its mode.

    The density over u = ln x is P(e^u) e^(-k u): its slope is zero where phi(z)/Phi(z) = k beta.
    """
    z = np.linspace(-4.0, 4.0, 80_001)
    inverse_mills = np.exp(-0.5 * z**2) / np.sqrt(2.0 * np.pi) / ndtr(z)
    mode = 0.4653 * np.exp(0.592 * z[np.argmin(np.abs(inverse_mills - 2.0 * 0.592))])
    _, beside = drawn()
    outline = beside.collections[0].get_paths()[0].vertices
    highest = np.asarray(outline)[np.asarray(outline)[:, 1] > 0.9 - 1e-9, 0]
    width = (2.0 / 0.02) ** (1.0 / 24.0)
    assert highest.min() / width < mode < highest.max() * width


def test_the_middle_of_the_risk_is_darker() -> None:
    _, beside = drawn()
    middle = np.concatenate([path.vertices for path in beside.collections[1].get_paths()])
    first, _, last = risk().contributing
    assert middle[:, 0].min() == pytest.approx(first, rel=0.02)
    assert middle[:, 0].max() == pytest.approx(last, rel=0.02)
