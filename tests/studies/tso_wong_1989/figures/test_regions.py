"""Figs 3 and 4: axes, curves and shares of the regions."""

import math
from dataclasses import replace

import numpy as np
import pytest
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from rocksteady.formulas import steady_states
from rocksteady.orbits import compute_region_boundaries, compute_region_map
from rocksteady.studies.tso_wong_1989.figures.regions import (
    FREQUENCIES,
    HIGHEST_AMPLITUDE,
    HIGHEST_FREQUENCY,
    PLANES,
    region_shares,
)
from tests.dynamics.formulae import printed_boundaries, printed_region
from tests.every import every

planes = pytest.mark.parametrize("plane", PLANES, ids=lambda plane: plane.id)


def drawn(figure: Figure) -> Axes:
    (axes,) = figure.axes
    return axes


def test_the_figures_have_the_papers_parameters() -> None:
    assert [(plane.id, plane.restitution, plane.order) for plane in PLANES] == [
        ("3a", 0.5, 1), ("3b", 0.95, 1), ("4a", 0.5, 3), ("4b", 0.95, 3),
    ]  # fmt: skip
    assert (HIGHEST_FREQUENCY, HIGHEST_AMPLITUDE) == (14.0, 6.0)


@pytest.mark.slow
@planes
def test_the_axes_are_the_papers(plane: object) -> None:
    axes = drawn(plane.panel().draw())  # type: ignore[attr-defined]
    assert axes.get_xlim() == (0.0, 14.0)
    assert axes.get_ylim() == (0.0, 6.0)
    assert (axes.get_xscale(), axes.get_yscale()) == ("linear", "linear")
    assert r"\Omega" in axes.get_xlabel()
    assert "amplitude" in axes.get_ylabel()


@pytest.mark.slow
@every(
    ("name", "expected"),
    [("3a", {1, 2, 3, 4}), ("4a", {1, 2, 3, 4, 5}), ("4b", {1, 2, 4})],
)
def test_regions_are_numbered_as_in_the_paper(name: str, expected: set[int]) -> None:
    (plane,) = (plane for plane in PLANES if plane.id == name)
    axes = drawn(plane.panel().draw())
    numbers = {int(text.get_text()) for text in axes.texts if text.get_text().isdigit()}
    assert numbers >= expected - {3}  # a sliver has no room for its number
    assert numbers <= expected | {3}
    for text in axes.texts:
        if text.get_text().isdigit():
            w, a = text.get_position()
            assert printed_region(a, w, plane.restitution, plane.order) == int(text.get_text())


@pytest.mark.slow
@planes
def test_every_equation_is_named_and_the_legend_stands_below_the_axes(plane: object) -> None:
    figure = plane.panel().draw()  # type: ignore[attr-defined]
    axes = drawn(figure)
    figure.draw_without_rendering()
    legend = axes.get_legend()
    words = [text.get_text() for text in axes.texts]
    if legend is not None:
        frame = legend.get_window_extent()
        assert figure.bbox.y0 <= frame.y0 < frame.y1 <= axes.get_window_extent().y0
        words += [text.get_text() for text in legend.get_texts()]
    for equation in ("(23)", "(24)", "(25)"):
        assert equation in " ".join(words)
    through = any("through the floor" in word for word in words)
    assert through == (plane.order == 3)  # type: ignore[attr-defined]


@planes
def test_the_table_holds_the_printed_boundaries(plane: object) -> None:
    panel = plane.panel()  # type: ignore[attr-defined]
    header = list(panel.header)
    columns = [header.index(name) for name in ("existence_eq23", "sign_eq24", "kind_eq25")]
    for row in list(panel.rows)[::97]:
        found = [row[column] for column in columns]
        expected = printed_boundaries(float(row[0]), plane.restitution, plane.order)  # type: ignore[attr-defined]
        assert found == pytest.approx(expected, rel=1e-11)
    assert float(panel.rows[-1][0]) == HIGHEST_FREQUENCY


@every(
    ("restitution", "order", "w", "existence", "kind", "sign"),
    [
        (0.5, 1, 4.0, 0.70825, 0.79129, 1.58816),
        (0.95, 1, 10.0, 0.06281, 0.06286, 1.57358),
        (0.5, 3, 8.0, 3.50833, 6.06806, 4.29984),
    ],
)
def test_the_planes_hold_the_reference_boundaries(
    restitution: float, order: int, w: float, existence: float, kind: float, sign: float
) -> None:
    (plane,) = (p for p in PLANES if (p.restitution, p.order) == (restitution, order))
    at = int(np.argmin(np.abs(plane.curves.frequency_ratio - w)))
    assert plane.curves.frequency_ratio[at] == pytest.approx(w)
    curves = (plane.curves.existence[at], plane.curves.kind[at], plane.curves.sign[at])
    assert curves == pytest.approx((existence, kind, sign), abs=5.1e-6)


# -------------------------------------------------------------------------------------- shares


@planes
def test_shares_add_up_to_the_window(plane: object) -> None:
    shares = plane.shares  # type: ignore[attr-defined]
    assert set(shares) == {1, 2, 3, 4, 5}
    assert sum(shares.values()) == pytest.approx(1.0, abs=1e-12)
    assert min(shares.values()) >= 0.0


@every(("restitution", "order"), [(0.5, 1), (0.95, 1), (0.5, 3), (0.95, 3), (0.15, 1), (0.3, 5)])
def test_shares_are_those_of_points_counted_on_a_fine_grid(restitution: float, order: int) -> None:
    low, high = float(FREQUENCIES[0]), float(FREQUENCIES[-1])
    points = 700
    w = low + (np.arange(points) + 0.5) * (high - low) / points
    a = (np.arange(points) + 0.5) * HIGHEST_AMPLITUDE / points
    region = steady_states(a[:, np.newaxis], w, restitution, order=order, with_shapes=False).region
    shares = region_shares(compute_region_map(FREQUENCIES, restitution, order=order))
    for number, share in shares.items():
        assert share == pytest.approx(float((region == number).mean()), abs=1.5e-3), number


def test_shares_do_not_count_what_lies_above_the_window() -> None:
    curves = compute_region_map(np.array([6.0, 8.0]), 0.5, order=3)
    for top in (1.0, 3.0, 5.0, 20.0):
        existence, sign, kind = printed_boundaries(8.0, 0.5, 3)
        flat = replace(
            curves,
            existence=np.full(2, existence),
            sign=np.full(2, sign),
            kind=np.full(2, kind),
        )
        shares = region_shares(flat, top)
        assert shares[4] == pytest.approx(min(existence, top) / top)
        assert shares[3] == pytest.approx(max(min(sign, top) - existence, 0.0) / top)
        assert shares[5] == pytest.approx(max(min(kind, top) - min(sign, top), 0.0) / top)
        assert shares[2] == pytest.approx(max(top - kind, 0.0) / top)
        assert shares[1] == 0.0


def test_region_3_lies_between_curves_in_the_ratio_of_the_printed_root() -> None:
    # E8: (23)/(25) = 1/sqrt(1 + P^2)
    for restitution in (0.3, 0.5, 0.95, 0.999):
        for order in (1, 3):
            curves = compute_region_boundaries(FREQUENCIES, restitution, order=order)
            d = (1.0 - restitution) / (1.0 + restitution)
            p = d * np.tanh(0.5 * math.pi * order / FREQUENCIES) * FREQUENCIES
            np.testing.assert_allclose(
                curves.existence / curves.kind, 1.0 / np.sqrt(1.0 + p * p), rtol=1e-12
            )
            assert (curves.existence < curves.kind).all()
