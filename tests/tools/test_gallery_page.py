"""The page of all pictures has every picture, from the data of the examples, on both papers."""

import contextlib
from functools import partial

import matplotlib as mpl
import pytest

import rocksteady as rs
from tests.public.calls import calls, room
from tests.show.all_pictures import FIGURES
from tests.show.drawn_figures import NAMES
from tools import gallery

mpl.use("agg")


def test_every_plot_is_drawn_by_an_example() -> None:
    """The page draws what the examples draw, so that each picture has data of its kind."""
    scripts = "".join(script.read_text("utf-8") for script in gallery.EXAMPLES.rglob("*.py"))
    assert [name for name in rs.plots.__all__ if f"plots.{name}(" not in scripts] == []
    assert set(gallery.WHOLE) == set(FIGURES)
    assert set(gallery.WHOLE.values()) <= {f"plot_{name}" for name in rs.plots.__all__}


@pytest.mark.slow
def test_every_whole_figure_and_every_plot_is_on_the_page(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(gallery, "asked", partial(gallery.asked, "steady"))
    monkeypatch.setattr(gallery, "FIGURES", {})
    with contextlib.chdir(room()):
        names = [name for name, _ in gallery.pictures()]
        plots = {name for name, call in calls().items() if "show.plots" in call.function.__module__}
    drawn = {name.partition(" ")[0] for name in names}
    assert set(NAMES) <= set(names)
    assert {name.partition(" ")[0] for name in plots} <= drawn
    assert len(set(names)) == len(names)
    assert "plot_steady_orbit 2: steady_orbits" in names


@pytest.mark.slow
def test_a_picture_is_shown_light_and_dark_wide_and_in_a_column_and_in_grey() -> None:
    draw = next(each for each in gallery.asked("steady") if "plot_response" in each.name)
    looks = [
        shown.partition('class="')[2].partition('"')[0].strip() for shown in gallery.shown(draw)
    ]
    assert looks == ["", "column", "column grey", "dark", "dark column"]
    assert len({shown.partition("src=")[2] for shown in gallery.shown(draw)}) == 4
