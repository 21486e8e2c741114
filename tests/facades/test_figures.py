"""The figure of a facade: a panel of each kind, at the width that is asked for."""

import pytest

from rocksteady.facades._figures import facade_figure
from rocksteady.show.style.page import Page
from tests.facades.page.checked_facades import alone, thin


def test_it_has_the_runs_where_there_are_any() -> None:
    assert len(facade_figure(alone()).axes) == 2
    figure = facade_figure(thin(), language="it")
    assert "nessuna verifica è soddisfatta" in figure.get_suptitle().replace("\n", " ")
    assert [axes.get_xlabel() for axes in figure.axes] == [
        "posizione [m]", "spostamento d [mm]", "spostamento massimo d/d₀",
    ]  # fmt: skip


@pytest.mark.slow
@pytest.mark.parametrize("width", [84.0, 174.0])
def test_it_is_as_wide_as_asked(width: float) -> None:
    figure = facade_figure(thin(), page=Page(width_mm=width))
    assert 25.4 * figure.get_figwidth() == pytest.approx(width)
    below = [axes.get_position().y1 for axes in figure.axes]
    assert (below == sorted(below, reverse=True)) or width > 100.0
    fewer = facade_figure(alone(), page=Page(width_mm=width))
    assert fewer.get_figheight() < figure.get_figheight()
