"""Whole figures at the widths of journals: nothing is cut off or too small, legends go anywhere."""

import re
import warnings
import zlib
from pathlib import Path
from typing import Any

import matplotlib as mpl

mpl.use("Agg")

import numpy as np
import pytest
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.legend import Legend
from matplotlib.lines import Line2D

from rocksteady import plots
from rocksteady.errors import InputError
from rocksteady.show.export.files import figure_bytes, save_figure
from rocksteady.show.style import palette
from rocksteady.show.style.legends import PLACES
from rocksteady.show.style.page import Page, _shorten, width_mm_of
from tests.every import every
from tests.show.drawn_figures import NAMES, TITLE, makers, texts_of


def legends(figure: Figure) -> list[Legend]:
    found: list[Legend] = figure.findobj(Legend)
    return found


@pytest.mark.slow
def test_every_kind_of_figure_is_here() -> None:
    assert set(NAMES) == set(makers())


@pytest.mark.slow
@every("name", NAMES)
def test_in_one_column_nothing_is_cut_off_too_small_or_covered(name: str) -> None:
    width = 84.0
    figure = makers()[name](Page(width_mm=width))
    with palette.style():  # as it is saved
        figure.draw_without_rendering()
    assert figure.get_figwidth() == pytest.approx(width / 25.4)
    box = figure.get_tightbbox()
    inches = figure.get_size_inches()
    slack = 0.02
    assert box.x0 > -slack, name
    assert box.y0 > -slack, name
    assert box.x1 < inches[0] + slack, name
    assert box.y1 < inches[1] + slack, name
    for text in texts_of(figure):
        assert float(text.get_fontsize()) >= 6.5, text.get_text()
    across = np.linspace(0.0, figure.bbox.width, 1000)
    boxes = [axes.bbox for axes in figure.axes]
    covered = np.any([(across > box.x0) & (across < box.x1) for box in boxes], axis=0)
    assert covered.mean() > 0.55, "axes, not a legend, have the width"
    check_uncovered(figure)


def hidden_by(legend: Legend) -> list[str]:
    """Return the lines and rings that a legend inside of its axes lies on."""
    axes, frame = legend.axes, legend.get_window_extent()
    found = []
    drawn: list[Any] = [*axes.lines, *(ring for ring in axes.patches if not ring.get_fill())]
    for each in drawn:
        shown = each.get_transform().transform_path(each.get_path())
        joined = not isinstance(each, Line2D) or each.get_linestyle() != "None"
        crossed = joined and shown.intersects_bbox(frame, filled=False)
        if crossed or (not joined and frame.count_contains(shown.vertices)):
            found.append(str(each.get_label()))
    return found


def check_uncovered(figure: Figure) -> None:
    """Refuse a legend that lies on a title, a line or a ring, and a name on which a line lies."""
    title = figure._suptitle  # type: ignore[attr-defined]
    for key in legends(figure):
        assert not title.get_window_extent().overlaps(key.get_window_extent())
        if key.axes is not None:
            assert hidden_by(key) == []
    for axes in figure.axes:  # no line goes through the name of a level
        for text in axes.texts:
            if text.get_text() == "lifts\noff":
                assert text.get_window_extent().x0 >= axes.bbox.x1


@pytest.mark.slow
@every("name", NAMES)
def test_legends_and_titles_lie_on_nothing(name: str) -> None:
    figure = makers()[name](Page())
    with palette.style():  # as it is saved
        figure.draw_without_rendering()
    check_uncovered(figure)


@pytest.mark.slow
@every(("name", "place"), [(name, PLACES[k % len(PLACES)]) for k, name in enumerate(NAMES)])
def test_every_legend_goes_where_it_is_wanted(name: str, place: str) -> None:
    figure = makers()[name](Page(width_mm=174.0, legend=place))  # type: ignore[arg-type]
    if place == "none":
        assert legends(figure) == []
        return
    if not legends(figure) and place != PLACES[0]:  # the same figure at every place
        return
    figure.draw_without_rendering()
    for legend in legends(figure):
        extent = legend.get_window_extent()
        owner: Axes | None = legend.axes
        if owner is None:  # of all panels together
            panels = [axes.bbox for axes in figure.axes]
            right, low = max(box.x1 for box in panels), min(box.y0 for box in panels)
            assert extent.x0 > right if place == "right" else extent.y1 < low
            continue
        box = owner.bbox
        if place == "inside":
            assert box.x0 - 1.0 <= extent.x0
            assert box.y0 - 1.0 <= extent.y0
            assert extent.x1 <= box.x1 + 1.0
            assert extent.y1 <= box.y1 + 1.0
        elif place == "right":
            assert extent.x0 > box.x1
        else:
            assert extent.y1 < box.y0
    box, inches = figure.get_tightbbox(), figure.get_size_inches()
    assert box.x0 > -0.02
    assert box.y0 > -0.02
    assert box.x1 < inches[0] + 0.02
    assert box.y1 < inches[1] + 0.02


@pytest.mark.slow
def test_a_legend_of_a_plot_goes_where_it_is_wanted_on_anybodys_axes() -> None:
    from tests.show.drawn_maps import found

    for layout in (None, "constrained"):
        for size in ((3.3, 2.5), (6.4, 4.8)):
            for place in (None, "right", "below"):
                figure = Figure(figsize=size, layout=layout)
                axes = plots.outcomes(found(), figure.add_subplot(), legend=place)
                figure.draw_without_rendering()
                legend = axes.get_legend()
                assert legend is not None
                extent = legend.get_window_extent()
                assert extent.x1 <= figure.bbox.x1 + 1.0, (layout, size, place)
                assert extent.y0 >= -1.0, (layout, size, place)
                assert axes.bbox.width > 0.3 * figure.bbox.width


def test_of_a_place_that_is_none_one_line_tells() -> None:
    from tests.show.drawn_figures import rocking

    for legend in ("left", "", 1, "RIGHT", ["right"], np.array(["right", "below"])):
        with pytest.raises(InputError, match="inside, right, below, none"):
            Page(legend=legend)  # type: ignore[arg-type]
        with pytest.raises(InputError, match="inside, right, below, none"):
            plots.trajectory(rocking(), Figure().add_subplot(), legend=legend)  # type: ignore[arg-type]


@every(
    ("text", "width"),
    [("84mm", 84.0), (" 8.4 cm ", 84.0), ("3.5in", 88.9), ("6.85in", 173.99), ("100.mm", 100.0)],
)
def test_a_width_has_its_unit(text: str, width: float) -> None:
    assert width_mm_of(text) == pytest.approx(width)


@every(
    "text",
    ["84", "-5mm", "1e9mm", "abc", "", "mm", "nanmm", "infmm", "84 MM", "84mm2", "8,4cm", "0in",
     "59mm", "1001mm", "84m", "84pt", "\u0661\u0662\u0660mm", "8" * 400 + "mm"],
)  # fmt: skip
def test_of_a_width_that_is_none_one_line_tells(text: str) -> None:
    with pytest.raises(InputError) as told:
        width_mm_of(text)
    message = str(told.value)
    assert "mm, cm or in" in message
    assert "\n" not in message


@every("width", [0, -84, float("nan"), float("inf"), "84mm", True, 59.0, 1e9])
def test_a_width_in_millimetres_has_its_range(width: object) -> None:
    with pytest.raises(InputError, match=r"\[60, 1000\]"):
        Page(width_mm=width)  # type: ignore[arg-type]


@pytest.mark.slow
def test_the_fonts_of_a_pdf_are_embedded_as_true_type(tmp_path: Path) -> None:
    file = tmp_path / "figure.pdf"
    save_figure("--plot", file, makers()["simulation"](Page()))
    data = file.read_bytes()
    unpacked = [data]
    for stream in re.findall(rb"stream\r?\n(.*?)endstream", data, re.DOTALL):
        try:
            unpacked.append(zlib.decompress(stream))
        except zlib.error:
            continue
    whole = b"".join(unpacked)
    assert b"/Type3" not in whole.replace(b" ", b"")
    assert b"/FontFile2" in whole
    assert b"/CIDFontType2" in whole.replace(b" ", b"")


@pytest.mark.slow
def test_a_users_settings_change_no_figure_of_the_program() -> None:
    plain = figure_bytes(makers()["simulation"](Page()), "svg")
    with mpl.rc_context({"text.color": "red", "pdf.fonttype": 3, "lines.linewidth": 1.3}):
        assert figure_bytes(makers()["simulation"](Page()), "svg") == plain


def test_a_narrow_title_stands_in_lines_that_say_all() -> None:
    figure = makers()["map"](Page(width_mm=84.0))
    suptitle = figure.get_suptitle()
    assert "\n" in suptitle
    assert suptitle.replace("\n", " ") == TITLE


def test_a_label_is_broken_where_it_is_longer_than_its_room() -> None:
    label = Figure().supxlabel("some words of a label")
    room = label.get_window_extent().width
    for given, lines in ((room, 1), (0.9 * room, 2)):
        _shorten(label, given, "width")
        assert len(label.get_text().splitlines()) == lines
    assert label.get_text().split() == ["some", "words", "of", "a", "label"]


@pytest.mark.slow
def test_no_figure_warns() -> None:
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        for place in ("right", "below"):
            figure_bytes(makers()["bifurcation"](Page(width_mm=60.0, legend=place)), "png")
