"""The capacity curve: its ends, its limits, and demands where their formulas put them."""

import math

import matplotlib.style
import numpy as np
import pytest
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.text import Annotation

from rocksteady.errors import InputError
from rocksteady.facades.checks.actions import Tie
from rocksteady.facades.checks.check_facade import check_facade
from rocksteady.facades.checks.facade import Facade
from rocksteady.facades.checks.facade_demand import FacadeDemand
from rocksteady.facades.plots.capacity import plot_facade_capacity
from rocksteady.facades.plots.languages import symbol
from rocksteady.show.export.files import figure_bytes
from rocksteady.show.style.tokens import DARK
from tests.facades.page.checked_facades import alone, site, thin, tied


def drawn(language: str = "en") -> Axes:
    return plot_facade_capacity(thin(), Figure().add_subplot(), language=language)


def points_of(axes: Axes, label: str) -> tuple[float, float]:
    (line,) = (line for line in axes.lines if str(line.get_label()) == label)
    x, y = (np.asarray(values, dtype=float) for values in line.get_data())
    return float(x[-1]), float(y[-1])


def test_it_falls_from_a0_to_zero_at_d0() -> None:
    """Of 0.3 x 3 m with FC 1.35: 4/3 t/h/FC, and 2 t/3."""
    x, y = (np.asarray(values, dtype=float) for values in drawn().lines[0].get_data())
    assert x.tolist() == pytest.approx([0.0, 200.0])
    assert y.tolist() == pytest.approx([4.0 / 30.0 / 1.35, 0.0])


def test_it_drops_where_a_tie_that_is_not_verified_ends() -> None:
    """Read back: a0 of the tied wall at 0, then the line of the wall without its tie."""
    for until, end in (({}, 0.0), ({"lost_at_m": 0.05}, 50.0)):
        facade = Facade(
            name="held", thickness_m=0.3, height_m=3.0, confidence_factor=1.0,
            ties=(Tie(name="rod", force_kn=2.0, z_m=3.0, **until),),  # type: ignore[arg-type]
        )  # fmt: skip
        axes = plot_facade_capacity(check_facade(facade), Figure().add_subplot())
        x, y = (np.asarray(values, dtype=float) for values in axes.lines[0].get_data())
        # M = 16.2 x .15 + 2 x 3 = 8.43 and 2.43, K = D = 24.3: alpha_0 .346914 and .1.
        drop = np.array([8.43, 2.43]) / 24.3 / 0.75 - end / 1500.0
        assert x[-3:-1] == pytest.approx([end, end])
        assert y[-3:-1] == pytest.approx(drop)
        assert (x[0], y[0]) == pytest.approx((0.0, 8.43 / 24.3 / 0.75))
        assert (x[-1], y[-1]) == pytest.approx((200.0, 0.0))


def test_limits_and_d0_stand_at_their_places_under_their_names() -> None:
    """Of .3 x 3 m: d0 = 2 t/3, and .4 and .6 of it."""
    limits = (("SLV", 80.0), ("SLC", 120.0), ("0", 200.0))
    uprights = {
        round(float(np.asarray(line.get_xdata())[0]), 9)
        for line in drawn().lines
        if np.ptp(np.asarray(line.get_xdata())) == 0.0 and len(np.asarray(line.get_xdata())) == 2
    }
    assert uprights == {80.0, 120.0, 200.0}
    names = {text.get_text(): text.xy[0] for text in drawn().texts if isinstance(text, Annotation)}
    expected = {symbol(f"d_{name}"): d for name, d in limits}
    assert names == pytest.approx({**expected, symbol("a_0"): 0.0})


def test_accelerations_stand_at_their_places_under_their_names() -> None:
    """Of 0.3 x 3 m, FC 1.35: a0 = 4/3 t/h/FC; the smaller, t/h/FC, decides the linear checks."""
    (named,) = (each for each in drawn().texts if each.get_text() == symbol("a_0"))
    assert isinstance(named, Annotation)
    assert named.xy == pytest.approx((0.0, 0.4 / 3.0 / 1.35))
    label = "capacity of the linear checks, min $a_0$"
    assert points_of(drawn(), label) == pytest.approx((0.0, 0.1 / 1.35))
    free = Facade(
        name="top", kind="parapet", thickness_m=0.3, height_m=2.0, confidence_factor=1.0,
        elastic_modulus_mpa=750.0, base_height_m=0.0,
    )  # fmt: skip
    axes = plot_facade_capacity(
        check_facade(free, FacadeDemand(slv=site(0.06))), Figure().add_subplot()
    )
    label = r"capacity of the linear checks, $\alpha_0$ g/FC"
    assert points_of(axes, label) == pytest.approx((0.0, 0.15))
    assert symbol("a_0") not in [each.get_text() for each in axes.texts]


def test_the_static_demand_is_that_of_the_spectrum_at_the_secant_period() -> None:
    """Its abscissa by formula (12), its ordinate the spectral acceleration itself."""
    period = 1.958239
    sa = site(0.15).sa_g(period, 0.08)
    x, y = points_of(drawn(), "static demand SLV")
    assert x == pytest.approx(1e3 * 9.80665 * sa * (period / (2.0 * math.pi)) ** 2, rel=1e-5)
    assert y == pytest.approx(sa, rel=1e-5)


def test_the_linear_demand_is_half_the_peak() -> None:
    assert points_of(drawn(), "linear demand SLV") == pytest.approx((0.0, 0.5 * 0.15 * 1.2))


def test_a_demand_of_runs_stands_at_their_mean() -> None:
    axes = plot_facade_capacity(tied(), Figure().add_subplot())
    runs = tied().runs
    assert runs is not None
    assert runs.mean_m is not None
    expected = pytest.approx((1e3 * runs.mean_m, 0.0))
    assert points_of(axes, "mean of runs SLV") == expected


def test_without_a_demand_there_are_capacity_and_periods_alone() -> None:
    axes = plot_facade_capacity(alone(), Figure().add_subplot())
    legend = axes.get_legend()
    assert legend is not None
    assert [text.get_text() for text in legend.get_texts()] == ["capacity a(d)"]
    assert len([text for text in axes.texts if text.get_text().startswith("$T")]) == 2


def test_italian_axes_have_italian_words_and_commas() -> None:
    axes = drawn(language="it")
    figure = axes.get_figure(root=True)
    assert figure is not None
    figure.draw_without_rendering()
    ticks = [label.get_text() for label in axes.get_yticklabels()]
    assert axes.get_xlabel() == "spostamento d [mm]"
    assert any("," in tick for tick in ticks)
    assert not any("." in tick for tick in ticks)
    legend = axes.get_legend()
    assert legend is not None
    assert "domanda statica SLV" in [text.get_text() for text in legend.get_texts()]


def test_it_is_legible_on_dark_paper_and_refuses_other_languages() -> None:
    with matplotlib.style.context("dark_background"):
        axes = plot_facade_capacity(thin(), Figure().add_subplot())
        assert axes.lines[0].get_color() == DARK.motion
        assert figure_bytes(axes.figure, "svg")  # type: ignore[arg-type]
    with pytest.raises(InputError, match="language"):
        drawn(language="fr")
