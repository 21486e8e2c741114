"""Twins of pictures: what is computed once, and which of the two a page shows."""

import io
from pathlib import Path
from typing import Any

import matplotlib as mpl
import numpy as np
import pytest
from docutils import nodes
from matplotlib.figure import Figure
from PIL import Image
from PIL.PngImagePlugin import PngInfo
from sphinx.application import Sphinx

import rocksteady as rs
from rocksteady.show.style import palette
from rocksteady.show.style.tokens import DARK, LIGHT
from tools.manual import images, twins


def test_a_function_that_a_script_names_gives_its_results_again_in_their_order() -> None:
    memory = twins.Memory()
    before = rs.formulas.housner_restitution
    memory.listen("rs.formulas.housner_restitution(a); rs.Block.plot; rs.plots.block; rs.nothing")
    first = [rs.formulas.housner_restitution(alpha) for alpha in (0.1, 0.2)]
    with memory.again():
        again = [rs.formulas.housner_restitution(alpha) for alpha in (0.3, 0.4)]
        new = rs.formulas.housner_restitution(0.3)
    assert again == first
    assert new == before(0.3)
    assert rs.formulas.housner_restitution(0.3) == new  # computed, now that it is over
    memory.restore()
    assert rs.formulas.housner_restitution is before


def test_the_house_style_is_on_the_paper_of_the_page_and_after_that_as_it_was() -> None:
    before = dict(palette.STYLE)
    with twins.on_paper(DARK, dpi=7.0), palette.style():
        assert mpl.rcParams["figure.facecolor"] == DARK.page
        assert mpl.rcParams["savefig.dpi"] == 7.0
    assert before == palette.STYLE


def test_a_saved_figure_has_no_ground_but_keeps_the_fills_of_its_axes(tmp_path: Path) -> None:
    figure = Figure(facecolor=LIGHT.page, figsize=(2.0, 1.0))
    plain, filled = figure.subplots(1, 2)
    plain.set_facecolor(LIGHT.page)
    filled.set_facecolor("red")
    for axes in (plain, filled):
        axes.set_axis_on()
        axes.set(xticks=[], yticks=[])
    twins.save(figure, tmp_path / "a.png", "script.py")
    with Image.open(tmp_path / "a.png") as picture:
        assert picture.info["Source"] == "script.py"
        pixels = np.asarray(picture)
    assert pixels[0, 0, 3] == 0
    assert pixels[50, 50, 3] == 0
    assert tuple(pixels[50, 140]) == (255, 0, 0, 255)
    assert plain.get_facecolor() == figure.get_facecolor()


def test_a_small_picture_keeps_its_colours_and_loses_its_ground(tmp_path: Path) -> None:
    file = tmp_path / "a.png"
    ground = tuple(int(DARK.page[k : k + 2], 16) for k in (1, 3, 5))
    picture = Image.new("RGB", (40, 40), ground)
    picture.paste((200, 10, 10), (10, 10, 30, 30))
    picture.save(file)
    images.make_small(file, DARK.page, "a script")
    with Image.open(file) as small:
        assert small.info["Source"] == "a script"
        pixels = np.asarray(small.convert("RGBA"))
    assert pixels[0, 0, 3] == 0
    assert tuple(pixels[20, 20]) == (200, 10, 10, 255)


@pytest.fixture(name="site")
def _site(tmp_path: Path) -> Any:
    """Return a function that builds a page of Markdown, and returns its HTML."""

    def build(page: str) -> str:
        (tmp_path / "conf.py").write_text("extensions = ['myst_parser', 'tools.manual.twins']\n")
        (tmp_path / "index.md").write_text(page, encoding="utf-8")
        out = tmp_path / "out"
        Sphinx(
            tmp_path, tmp_path, out, tmp_path / "trees", "html", status=None, warning=io.StringIO()
        ).build()
        return (out / "index.html").read_text(encoding="utf-8")

    return build


def png(file: Path, **words: str) -> Path:
    """Write a PNG with words in it."""
    info = PngInfo()
    for name, text in words.items():
        info.add_text(name, text)
    file.parent.mkdir(exist_ok=True)
    Image.new("RGB", (2, 2)).save(file, pnginfo=info)
    return file


def test_a_page_shows_the_twin_that_fits_its_theme_and_a_single_picture_always(
    site: Any, tmp_path: Path
) -> None:
    for name in ("a.png", "a_dark.png", "b.png"):
        png(tmp_path / "images" / name)
    text = site("# Top\n\n![two](images/a.png)\n\n![one](images/b.png)\n")
    assert '<img alt="two" class="only-light" src="_images/a.png" />' in text
    assert '<img alt="two" class="only-dark" src="_images/a_dark.png" />' in text
    assert '<img alt="one" src="_images/b.png" />' in text


@pytest.mark.parametrize("papers", [("light", "dark"), ("light", "light", "dark")])
def test_pictures_of_a_cell_are_twins_where_each_has_one(
    papers: tuple[str, ...], tmp_path: Path
) -> None:
    pictures = [
        (nodes.image(uri=str(k)), png(tmp_path / f"{k}.png", Paper=paper))
        for k, paper in enumerate(papers)
    ]
    cell = nodes.container("", *(picture for picture, _ in pictures))
    twins.pair(pictures)
    looks = [each["classes"] for each in cell.children if isinstance(each, nodes.image)]
    assert looks == ([["only-light"], ["only-dark"]] if len(papers) == 2 else [[], []])
