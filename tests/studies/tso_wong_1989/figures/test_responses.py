"""Figs 5 to 7: axes, and peaks against the reference numbers and a sampled half cycle."""

import math
from typing import Any

import numpy as np
import pytest

from rocksteady.studies.tso_wong_1989.figures.responses import RESPONSES, Responses
from tests.dynamics.formulae import half_cycle, printed
from tests.every import every

BY_NAME = {response.id: response for response in RESPONSES}
responses = pytest.mark.parametrize("response", RESPONSES, ids=lambda response: response.id)


def peak(name: str, value: float, x: float) -> float:
    """The peak that the table of a figure holds for a curve at an abscissa."""
    rows: Any = BY_NAME[name].panel().rows
    (found,) = (row[2] for row in rows if row[0] == value and math.isclose(row[1], x))
    assert isinstance(found, float)
    return found


@pytest.mark.slow
@every(
    ("name", "end", "label"),
    [
        ("5a", 16.0, r"\Omega"), ("5b", 16.0, r"\Omega"),
        ("6a", 16.0, "[Hz]"), ("6b", 16.0, "[Hz]"),
        ("7a", 14.0, r"\Omega"), ("7b", 14.0, r"\Omega"),
    ],
)  # fmt: skip
def test_the_axes_are_the_papers(name: str, end: float, label: str) -> None:
    (axes,) = BY_NAME[name].panel().draw().axes
    assert axes.get_xlim() == (0.0, end)
    assert axes.get_ylim() == (0.0, 1.0)
    assert (axes.get_xscale(), axes.get_yscale()) == ("linear", "linear")
    assert label in axes.get_xlabel()
    assert r"\theta" in axes.get_ylabel()
    legend = axes.get_legend()
    assert legend is not None
    words = [legend.get_title(), *legend.get_texts(), *axes.texts]
    texts = [word.get_text() for word in words]
    assert set(BY_NAME[name].labels) <= set(texts)
    assert "solid: stable, dashed: unstable" in texts


def test_the_curves_are_those_of_the_paper() -> None:
    assert BY_NAME["5a"].values == BY_NAME["5b"].values == (1.0, 2.0, 3.0, 4.0, 5.0, 6.0)
    assert BY_NAME["7a"].values == BY_NAME["7b"].values == (0.7, 0.8, 0.9, 1.0)
    assert len(BY_NAME["6a"].values) >= 3
    assert [response.order for response in RESPONSES] == [1, 3, 1, 3, 1, 3]
    for response in RESPONSES:
        text = " ".join(response.panel().choices)
        assert ("not legible" in text) == (response.quantity != "amplitude")


@every(
    ("name", "a", "w", "expected"),
    [
        ("5a", 1.0, 2.0, 0.43188), ("5a", 1.0, 4.0, 0.12635), ("5a", 1.0, 8.0, 0.03298),
        ("5a", 3.0, 3.0, 0.41518), ("5a", 3.0, 4.0, 0.24397), ("5a", 3.0, 8.0, 0.06373),
        ("5a", 6.0, 4.0, 0.41873), ("5a", 6.0, 8.0, 0.10940),
        ("5b", 2.0, 5.0, 0.38246), ("5b", 2.0, 8.0, 0.17832),
        ("5b", 3.0, 4.0, 0.57409), ("5b", 3.0, 8.0, 0.18981), ("5b", 6.0, 6.0, 0.39555),
    ],
)  # fmt: skip
def test_figure_5_holds_the_reference_peaks(name: str, a: float, w: float, expected: float) -> None:
    assert peak(name, a, w) == pytest.approx(expected, abs=5.1e-6)


def test_figure_5b_has_no_curve_where_there_is_no_motion() -> None:
    for a, w in ((1.0, 4.0), (1.0, 8.0), (1.0, 16.0), (2.0, 12.0)):
        assert math.isnan(peak("5b", a, w))


@pytest.mark.parametrize(
    ("name", "w", "expected"),
    [
        ("7a", 4.0, (0.236912, 0.243970, 0.247783, 0.248915)),
        ("7b", 6.0, (0.324958, 0.310461, 0.282634, 0.243701)),
    ],
)
def test_figure_7_holds_the_reference_peaks(
    name: str, w: float, expected: tuple[float, ...]
) -> None:
    for restitution, value in zip((0.7, 0.8, 0.9, 1.0), expected, strict=True):
        assert peak(name, restitution, w) == pytest.approx(value, abs=5.1e-7)


@pytest.mark.parametrize(("name", "order"), [("6a", 1), ("6b", 3)])
def test_figure_6_is_figure_5_with_the_frequency_in_hertz(name: str, order: int) -> None:
    # omega/p is Omega: at p = 2 pi rad/s the abscissas are the same numbers.
    other = {1: "5a", 3: "5b"}[order]
    for x in (4.0, 8.0, 12.0):
        assert peak(name, 2.0 * math.pi, x) == pytest.approx(peak(other, 3.0, x), rel=1e-11)
        assert peak(name, math.pi, x) == pytest.approx(
            peak(name, 2.0 * math.pi, 2.0 * x) if 2.0 * x <= 16.0 else peak(name, math.pi, x),
            rel=1e-9,
        )


@every("name", ["5a", "5b", "7a", "7b"])
def test_every_peak_is_that_of_a_sampled_half_cycle(name: str) -> None:
    response = BY_NAME[name]
    rng = np.random.default_rng(5)
    table: Any = response.panel().rows
    rows = [row for row in table if math.isfinite(row[2])]
    for index in rng.integers(0, len(rows), 25):
        value, w, found, _ = rows[index]
        a, r = (value, 0.8) if response.quantity == "amplitude" else (3.0, value)
        if w < 0.5 or r == 1.0:
            continue  # a long half cycle loses its digits to exp(n pi/Omega) in the printed form
        solution = printed(a, w, r, response.order, 1)
        _, angle = half_cycle(a, w, response.order, solution.phase, solution.velocity, 4001)
        assert angle.min() > -1e-9
        assert angle.max() == pytest.approx(found, abs=1e-5)


@responses
def test_the_table_holds_what_is_drawn(response: Responses) -> None:
    panel = response.panel()
    (axes,) = panel.draw().axes
    rows: Any = np.array(panel.rows, dtype=float)
    for value, label in zip(response.values, response.labels, strict=True):
        (line,) = (line for line in axes.lines if line.get_label() == label)
        mine = rows[rows[:, 0] == value]
        np.testing.assert_array_equal(np.asarray(line.get_xdata(), dtype=float), mine[:, 1])
        solid = np.asarray(line.get_ydata(), dtype=float)
        np.testing.assert_array_equal(np.isfinite(solid), mine[:, 3] == 1.0)
        np.testing.assert_array_equal(solid[np.isfinite(solid)], mine[mine[:, 3] == 1.0, 2])


@responses
def test_the_words_say_where_each_curve_ends(response: Responses) -> None:
    computed = response.panel().computed
    for label in response.labels:
        assert label in computed
    for curve, label in zip(response.curves, response.labels, strict=True):
        sentence = computed.split(f"{label}: ")[1].split(f" {response.labels[0][0]} = ")[0]
        there = np.isfinite(curve.peak)
        assert ("to the end of the axis" in sentence.split(".  ")[0]) >= bool(there[-1])
