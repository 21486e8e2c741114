"""The page of all pictures has every picture, on both papers."""

from tests.public.calls import calls
from tests.show.drawn_figures import NAMES
from tools import gallery


def test_every_whole_figure_and_every_plot_is_on_the_page() -> None:
    names = [name for name, _ in gallery.pictures()]
    plots = {name for name, call in calls().items() if "show.plots" in call.function.__module__}
    assert set(NAMES) <= set(names)
    assert plots <= set(names)
    assert len(set(names)) == len(names)


def test_a_picture_is_shown_light_and_dark_wide_and_in_a_column_and_in_grey() -> None:
    draw = dict(gallery.pictures())["plot_husid"]
    looks = [
        shown.partition('class="')[2].partition('"')[0].strip() for shown in gallery.shown(draw)
    ]
    assert looks == ["", "column", "column grey", "dark", "dark column"]
    assert len({shown.partition("src=")[2] for shown in gallery.shown(draw)}) == 4
