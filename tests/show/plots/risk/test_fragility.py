"""Pictures of fragility: what is drawn is what was fitted, with its range, gate and records."""

import math
from functools import cache
from typing import Any

import numpy as np
import pytest
import xarray
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection
from matplotlib.figure import Figure
from scipy import stats

from rocksteady import plots
from rocksteady.errors import InputError
from rocksteady.measures import Measure
from rocksteady.risk import (
    DamageState,
    FitOptions,
    Fragility,
    FragilityCurve,
    StateFragility,
    TwoStageCurve,
    fit_curve,
    fit_two_stages,
)
from rocksteady.show.figures.risk import fragility_figure
from rocksteady.show.style.page import Page
from rocksteady.show.style.tokens import inks_of
from tests.every import every
from tests.show.drawn_figures import texts_of

LEVELS = np.geomspace(0.1, 3.2, 12)
RECORDS, TRIALS = 30, 4


def counts(median: float, seed: int = 1) -> np.ndarray:
    rng = np.random.default_rng(seed)
    p = stats.norm.cdf(np.log(LEVELS / median) / 0.5)
    return rng.binomial(TRIALS, np.tile(p, RECORDS))


@cache
def two_stages(gate: float | None = 0.29, median: float = 0.7) -> TwoStageCurve:
    at = np.tile(LEVELS, RECORDS)
    groups = np.repeat(np.arange(RECORDS), len(LEVELS))
    lifted = (
        np.full(len(at), TRIALS) * (at > gate) if gate else np.maximum(counts(0.3), counts(median))
    )
    return fit_two_stages(
        at, lifted, np.minimum(lifted, counts(median)), np.full(len(at), TRIALS),
        groups=groups, measure=("PGA", "g"),
    )  # fmt: skip


def axes() -> Axes:
    return Figure().add_subplot()


def entries(drawn: Axes) -> list[str]:
    legend = drawn.get_legend()
    assert legend is not None
    return [text.get_text().replace("\N{NO-BREAK SPACE}", " ") for text in legend.get_texts()]


def named(drawn: Axes) -> list[str]:
    """What stands beside a curve, a line or a band, without its line breaks."""
    return [" ".join(text.get_text().split()) for text in drawn.texts]


def test_points_are_the_shares_with_wilsons_interval_of_as_many_trials_as_records() -> None:
    curve = two_stages()
    drawn = plots.fragility(curve, axes())
    (points,) = [line for line in drawn.lines if line.get_marker() == "o"]
    failures = counts(0.7).reshape(RECORDS, -1) * (LEVELS > 0.29)
    shares = failures.sum(axis=0) / (RECORDS * TRIALS)
    np.testing.assert_allclose(np.asarray(points.get_xdata()), LEVELS, rtol=1e-12)
    np.testing.assert_allclose(np.asarray(points.get_ydata()), shares, atol=1e-12)
    (bars,) = [each for each in drawn.collections if isinstance(each, LineCollection)]
    for share, path in zip(shares, bars.get_paths(), strict=True):
        low, high = np.asarray(path.vertices)[:, 1]
        # Wilson's ends solve |share - p| = z sqrt(p (1 - p)/n).
        z = stats.norm.ppf(0.95)
        for end in (low, high):
            if 1e-9 < end < 1.0 - 1e-9:
                assert abs(share - end) == pytest.approx(z * math.sqrt(end * (1 - end) / RECORDS))
    assert entries(drawn)[0] == "share of runs, 90 % bar of 30 records"


def test_the_curve_is_solid_where_it_was_run_and_dashed_beyond() -> None:
    curve = two_stages()
    drawn = plots.fragility(curve, axes())
    for line in drawn.lines:
        at = np.asarray(line.get_xdata(), dtype=float)
        inside = at.min() >= LEVELS[0] - 1e-12 and at.max() <= LEVELS[-1] + 1e-12
        if line.get_linewidth() > 1.5:
            assert (line.get_linestyle() == "-") == inside
            np.testing.assert_allclose(np.asarray(line.get_ydata()), curve.probability(at))
    thick = [line for line in drawn.lines if line.get_linewidth() > 1.5]
    assert len(thick) == 3
    low, high = drawn.get_xlim()
    assert (low, high) == pytest.approx((LEVELS[0] / 1.35, LEVELS[-1] * 1.35))
    assert "not run" in entries(drawn)


def test_the_plain_curve_stands_beside_and_medians_are_named() -> None:
    curve = two_stages()
    words = entries(plots.fragility(curve, axes()))
    assert f"one curve, median {curve.plain.median:.3g} g, β {curve.plain.beta:.3g}" in words


def test_curve_and_median_are_named_beside_them_where_there_is_room() -> None:
    curve = two_stages()
    drawn = plots.fragility(curve, axes())
    assert f"half fall at {curve.median:.3g} g" in named(drawn)
    assert "fitted curve in two stages" in named(drawn)
    assert "in two stages" not in entries(drawn)
    (half,) = [line for line in drawn.lines if len(np.asarray(line.get_xdata())) == 3]
    assert half.get_xydata()[1] == pytest.approx((curve.median, 0.5))  # type: ignore[index]
    assert half.get_color() == inks_of(drawn).quiet
    with Page(width_mm=84).figure(6.6, 4.4, "") as figure:
        narrow = plots.fragility(curve, figure.add_subplot())
    assert f"half fall at {curve.median:.3g} g" in named(narrow)
    assert "in two stages" in entries(narrow)


@pytest.mark.slow
def test_a_name_hides_neither_its_curve_nor_a_share() -> None:
    for found in (two_stages(), two_stages(None), two_stages(None, 1.6), two_stages(0.15, 0.25)):
        drawn = plots.fragility(found, axes())
        figure = drawn.get_figure(root=True)
        assert figure is not None
        figure.draw_without_rendering()
        texts = [each for each in drawn.texts if each.get_text().startswith("fitted")]
        for box in (text.get_window_extent() for text in texts):
            places = [
                drawn.transData.transform(np.column_stack(line.get_data()))
                for line in drawn.lines
                if line.get_color() == inks_of(drawn).risk or line.get_marker() == "o"
            ]
            assert not box.count_contains(np.concatenate(places))


def test_a_name_lies_beside_the_line_of_uplift() -> None:
    levels, fell = np.geomspace(0.1, 1.5, 8), [0, 0, 0, 21, 30, 34, 36, 37]
    curve = fit_two_stages(levels, 0.232, fell, [40] * 8, measure=("PGA", "g"))
    drawn = plots.fragility(curve, Figure(figsize=(5.0, 4.6)).add_subplot())
    figure = drawn.get_figure(root=True)
    assert figure is not None
    figure.draw_without_rendering()
    (name,) = [each for each in drawn.texts if each.get_text().startswith("fitted")]
    box, (across, _) = name.get_window_extent(), drawn.transData.transform((0.232, 0.5))
    assert not box.x0 <= across <= box.x1


def test_probabilities_have_the_hue_of_risk_and_an_axis_from_0_to_100_per_cent() -> None:
    drawn = plots.fragility(two_stages(), axes())
    inks = inks_of(drawn)
    assert {line.get_color() for line in drawn.lines if line.get_linewidth() > 1.5} == {inks.risk}
    (points,) = [line for line in drawn.lines if line.get_marker() == "o"]
    assert points.get_color() == inks.observed
    low, high = drawn.get_ylim()
    assert low < 0.0
    assert high > 1.0
    ticks = [text.get_text() for text in drawn.get_yticklabels()]
    assert (ticks[0], ticks[-1]) == ("0\N{NO-BREAK SPACE}%", "100\N{NO-BREAK SPACE}%")


def test_a_step_of_uplift_is_a_gate_and_any_other_a_curve() -> None:
    gated = plots.fragility(two_stages(), axes())
    (limit,) = [word for word in named(gated) if word.startswith("uplift")]
    below, above = LEVELS[LEVELS <= 0.29][-1], LEVELS[LEVELS > 0.29][0]
    assert limit == f"uplift between {below:.3g} and {above:.3g} g"
    upright = [np.unique(line.get_xdata()) for line in gated.lines]
    (at,) = [
        x[0]
        for x, line in zip(upright, gated.lines, strict=True)
        if len(x) == 1 and line.get_marker() == "None"
    ]
    assert below < at < above
    assert "uplift" in named(plots.fragility(two_stages(None), axes()))


def test_an_exact_gate_is_drawn_at_its_intensity() -> None:
    fell, labels = [0, 3, 33, 39], ("PGA", "g")
    curve = fit_two_stages([0.2, 0.4, 0.8, 1.6], 0.277, fell, [40] * 4, measure=labels)
    for size in ((9.0, 4.8), (3.3, 2.5)):  # beside it, or in the legend
        drawn = plots.fragility(curve, Figure(figsize=size).add_subplot())
        assert ("uplift at 0.277 g" in named(drawn)) == (size[0] > 6.0)
        assert ("uplift at 0.277 g" in entries(drawn)) == (size[0] < 6.0)


def test_a_band_is_shaded_over_what_was_run() -> None:
    class Banded(FragilityCurve):
        def probability_band(self, intensity: Any) -> Any:
            middle = self.probability(intensity)
            return 0.8 * middle, np.minimum(1.2 * middle, 1.0)

    plain = two_stages().plain
    values = {name: getattr(plain, name) for name in plain.__dataclass_fields__}
    drawn = plots.fragility(Banded(**values), axes())
    (shade,) = [each for each in drawn.collections if "band" in str(each.get_label())]
    outline = np.asarray(shade.get_paths()[0].vertices)
    assert outline[:, 0].min() == pytest.approx(LEVELS[0])
    assert outline[:, 0].max() == pytest.approx(LEVELS[-1])


@every(
    ("failures", "word"),
    [
        ([0, 0, 0, 0], "never in any run"),
        ([10, 10, 10, 10], "in every run"),
        ([0, 0, 10, 10], "step between 0.2 and 0.3 m/s"),
        ([9, 6, 4, 1], "no curve: not more frequent with intensity"),
    ],
)
def test_data_without_a_curve_have_their_points_and_say_so(failures: list[int], word: str) -> None:
    curve = fit_curve([0.1, 0.2, 0.3, 0.4], failures, [10] * 4, measure=("PGV", "m/s"))
    drawn = plots.fragility(curve, axes())
    (points,) = [line for line in drawn.lines if line.get_marker() == "o"]
    np.testing.assert_allclose(np.asarray(points.get_ydata()) * 10, failures)
    shown = " ".join([*entries(drawn), *named(drawn)])
    assert word in shown
    assert "nan" not in shown


@pytest.mark.parametrize(
    ("failures", "left"), [([0, 0, 0, 0], True), ([10, 10, 10, 10], False), ([9, 6, 4, 1], True)]
)
def test_without_a_curve_the_legend_leaves_the_points_free(failures: list[int], left: bool) -> None:
    curve = fit_curve([0.1, 0.2, 0.3, 0.4], failures, [10] * 4, measure=("PGV", "m/s"))
    figure = Figure()
    drawn = plots.fragility(curve, figure.add_subplot(), legend="inside")
    figure.draw_without_rendering()
    legend = drawn.get_legend()
    assert legend is not None
    box = drawn.transAxes.inverted().transform_bbox(legend.get_window_extent())
    assert (box.x1 < 0.6, box.y0 > 0.5) == (left, left), box


NAMES = ["uplift", "theta/alpha > 0.5", "over$turned_"]


@cache
def several(*given: bool) -> Fragility:
    """Return three states, of which some are of the blocks that lift."""
    return Fragility(
        ensemble=xarray.Dataset(attrs={"gate_g": math.nan}),
        measure=Measure("pga_g"),
        states=tuple(
            StateFragility(
                state=DamageState(name, peak), plain=each.plain, two_stage=each, given_uplift=lifted
            )
            for name, peak, each, lifted in zip(
                NAMES,
                (None, 0.5, 0.7),
                (two_stages(None, median) for median in (0.4, 0.6, 0.8)),
                given or (False,) * 3,
                strict=True,
            )
        ),
        ranking=(),
        fitting=FitOptions(bands=None),
        warnings=(),
        records=RECORDS,
        runs=RECORDS * TRIALS,
        scale_factor_max=1.0,
        seconds=0.0,
    )


def test_all_states_are_in_the_legend_in_order_with_their_points() -> None:
    found = several()
    drawn = plots.fragility_states(found, axes())
    assert entries(drawn)[:3] == ["uplift", "θ/α > 0.5", r"over\$turned_"]
    dots = [line for line in drawn.lines if line.get_linestyle() == "None"]
    assert len(dots) == 3
    assert len({line.get_marker() for line in dots}) == 3
    assert {str(line.get_markerfacecolor()) for line in dots} == {inks_of(drawn).observed}
    curves = [line for line in drawn.lines if line.get_linestyle() == "-"]
    assert [line.get_color() for line in curves] == inks_of(drawn).series("motion", 3)[::-1]


def test_a_condition_of_all_curves_is_at_the_abscissa_and_one_of_some_with_their_names() -> None:
    mixed = plots.fragility_states(several(False, True, True), axes())
    assert mixed.get_xlabel() == "PGA [g]"
    assert entries(mixed)[:3] == [
        "uplift",
        "θ/α > 0.5, given uplift",
        r"over\$turned_, given uplift",
    ]
    alike = plots.fragility_states(several(True, True, True), axes())
    assert alike.get_xlabel() == "PGA [g], given uplift"
    assert not any("given" in each for each in entries(alike))
    alone = plots.fragility(several(False, True, True), axes())
    assert alone.get_xlabel() == "PGA [g], given uplift"


def test_a_fragility_and_its_curves_plot_themselves() -> None:
    found = several()
    for each in (found, found.states[0].plain, two_stages()):
        assert each.plot(axes()).get_xlabel() == "PGA [g]"


@pytest.mark.slow
def test_a_state_is_chosen_by_its_name_and_the_last_by_default() -> None:
    found = several()
    assert plots.fragility(found, axes()).get_ylabel() == r"probability of over\$turned_"
    assert plots.fragility(found, axes(), state="uplift").get_ylabel() == "probability of lifting"
    with pytest.raises(InputError, match="the damage states are uplift, theta/alpha"):
        plots.fragility(found, axes(), state="fallen")


@pytest.mark.slow
@every("width", [84.0, 174.0, None])
@every("dark", [False, True])
def test_texts_are_large_enough_and_inside_the_figure(width: float | None, dark: bool) -> None:
    figure = fragility_figure(several(), title="A cabinet", page=Page(width_mm=width))
    if dark:
        with Page(width_mm=width).figure(6.6, 4.4, "A cabinet") as figure:
            figure.set_facecolor("#111111")
            plots.fragility(two_stages(), figure.add_subplot(facecolor="#111111"))
    figure.draw_without_rendering()
    for text in texts_of(figure):
        assert float(text.get_fontsize()) >= 6.5
        box = text.get_window_extent()
        if box.width and text.get_clip_on() is False:
            assert box.x0 >= -1.0, text.get_text()
            assert box.x1 <= figure.bbox.x1 + 1.0, text.get_text()
