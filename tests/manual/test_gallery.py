"""The gallery: short scripts of public names, which together show every plot of the package."""

import ast
import inspect
import itertools
import re
import runpy
from collections.abc import Iterator
from operator import attrgetter
from pathlib import Path
from typing import Any

import matplotlib as mpl
import matplotlib.pyplot as plt
import numpy as np
import pytest
from PIL import Image

import rocksteady as rs
from rocksteady.show.style import palette
from rocksteady.show.style.tokens import DARK, LIGHT, Inks, inks_of
from tests.every import every
from tools.manual import gallery
from tools.namespace import MODULES, PLACES

DOCS = gallery.EXAMPLES.parent / "docs"
SCRIPTS = {str(path.relative_to(gallery.EXAMPLES)): path for path in gallery.EXAMPLES.rglob("*.py")}
TREES = {name: ast.parse(path.read_text(encoding="utf-8")) for name, path in SCRIPTS.items()}
PLOTS = {f"plots.{name}" for name in rs.plots.__all__}
LINES = 30
IN_A_FOLDER = 13


def public_names(tree: ast.Module) -> set[str]:
    """Return the public names that a script uses, as ``plots.trajectory``."""
    texts = [ast.unparse(node) for node in ast.walk(tree) if isinstance(node, ast.Attribute)]
    used = [re.split(r"\W", text)[1:3] for text in texts if text.startswith("rs.")]
    return {".".join(parts[: 1 + (parts[0] in MODULES)]) for parts in used} - {*MODULES}


def caption(name: str) -> list[str]:
    """Return the lines of the docstring of a script."""
    text = ast.get_docstring(TREES[name])
    assert text is not None
    return text.splitlines()


def test_there_are_thirty_scripts_or_more_and_not_too_many_in_a_folder() -> None:
    assert len(SCRIPTS) >= 30
    for folder in gallery.ORDER:
        assert 3 <= len(list((gallery.EXAMPLES / folder).glob("*.py"))) <= IN_A_FOLDER
    assert {name.partition("/")[0] for name in SCRIPTS} == set(gallery.ORDER)


@every("folder", ["", *gallery.ORDER])
def test_each_section_has_a_title_and_a_sentence(folder: str) -> None:
    header = (gallery.EXAMPLES / folder / "GALLERY_HEADER.rst").read_text(encoding="utf-8")
    title, line, empty, *text = header.splitlines()
    assert set(line) <= {"=", "-"}
    assert len(line) == len(title)
    assert not empty
    assert "".join(text).endswith(".")


@every("name", SCRIPTS)
def test_a_script_is_a_question_its_answer_and_at_most_thirty_lines(name: str) -> None:
    assert len(SCRIPTS[name].read_text(encoding="utf-8").splitlines()) <= LINES
    title, line, empty, *text = caption(name)
    assert title.endswith("?")
    assert line == "=" * len(title)
    assert not empty
    sentences = re.findall(r"[.?](?= |$)", " ".join(text))
    assert 2 <= len(sentences) <= 6, text
    pages = re.findall(r":doc:`/([\w/-]+)`", " ".join(text))
    assert pages
    for page in pages:
        assert (DOCS / f"{page}.md").is_file(), page


def test_no_two_scripts_have_one_title() -> None:
    titles = [caption(name)[0] for name in SCRIPTS]
    assert len(set(titles)) == len(titles)


@every("name", SCRIPTS)
def test_a_script_uses_public_names_numpy_and_matplotlib_alone(name: str) -> None:
    imports = [node for node in ast.walk(TREES[name]) if isinstance(node, ast.Import)]
    assert not [node for node in ast.walk(TREES[name]) if isinstance(node, ast.ImportFrom)]
    modules = {(alias.name, alias.asname) for node in imports for alias in node.names}
    assert ("rocksteady", "rs") in modules
    assert modules <= {("rocksteady", "rs"), ("numpy", "np"), ("matplotlib.pyplot", "plt")}
    assert public_names(TREES[name]) <= set(PLACES.values())


def test_every_plot_of_the_package_is_shown() -> None:
    shown = set().union(*(public_names(tree) for tree in TREES.values()))
    assert shown >= PLOTS
    assert all(inspect.isfunction(attrgetter(name)(rs)) for name in PLOTS)


@pytest.fixture
def _settings() -> Iterator[None]:
    """Restore the settings of Matplotlib and close all figures."""
    before = dict(mpl.rcParams)
    yield
    plt.close("all")
    mpl.rcParams.update(before)


@every("inks", [LIGHT, DARK])
@pytest.mark.usefixtures("_settings")
def test_the_style_is_that_of_the_package_whatever_a_script_before_has_set(inks: Inks) -> None:
    mpl.rcParams["axes.facecolor"] = "red"
    plt.figure()
    gallery.set_style(inks)
    assert not plt.get_fignums()
    assert mpl.rcParams["font.size"] == palette.STYLE["font.size"]
    found = inks_of(plt.figure().add_subplot())
    assert (found.dark, found.paper) == (inks.dark, inks.page)
    assert mpl.rcParams["axes.prop_cycle"].by_key()["color"][0] == inks.motion
    assert mpl.rcParams["text.color"] == inks.ink


def shown(name: str, folder: Path) -> str:
    """Return the text that shows the pictures of a script, which are saved to a folder."""
    gallery.prepare({}, Path(name).name)
    variables = {
        "example_globals": runpy.run_path(str(SCRIPTS[name])),
        "image_path_iterator": (str(folder / f"drawn_{k:03d}.png") for k in itertools.count(1)),
        "src_file": str(SCRIPTS[name]),
    }
    return gallery.save_pictures(None, variables, {"src_dir": folder, "thumbnail_size": (42, 29)})


@pytest.mark.slow
@pytest.mark.usefixtures("_settings")
def test_a_film_becomes_two_small_gifs_that_play(tmp_path: Path) -> None:
    text = shown("histories/film.py", tmp_path)
    assert ".. image:: /drawn_001.gif\n" in text
    assert ":alt: How does a statue fall?\n" in text
    for name in ("drawn_001.gif", "drawn_001_dark.gif", "thumb/sphx_glr_film_thumb_dark.gif"):
        with Image.open(tmp_path / name) as picture:
            assert getattr(picture, "n_frames", 1) > 1


@pytest.mark.slow
@pytest.mark.usefixtures("_settings")
def test_a_script_draws_on_both_papers_computes_once_and_leaves_no_ground(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    calls = []

    def simulate(*args: Any, **kwargs: Any) -> Any:
        calls.append(args)
        return compute(*args, **kwargs)

    compute = rs.simulate
    monkeypatch.setattr(rs, "simulate", simulate)
    assert shown("histories/record.py", tmp_path)
    light, dark = (Image.open(tmp_path / f"drawn_001{end}.png") for end in ("", "_dark"))
    assert light.size == dark.size
    for picture in (light, dark):
        assert picture.getpixel((0, 0))[3] == 0  # type: ignore[index]
        assert picture.info["Source"] == "examples/histories/record.py"
    ink = [np.asarray(each)[np.asarray(each)[..., 3] == 255] for each in (light, dark)]
    assert ink[0].mean() < ink[1].mean()
    assert rs.simulate is simulate
    assert len(calls) == 1


def test_a_page_whose_script_is_gone_is_removed(tmp_path: Path) -> None:
    pages, scripts = tmp_path / "gallery", tmp_path / "examples"
    for folder in (pages / "maps", scripts / "maps"):
        folder.mkdir(parents=True)
    for page in ("index.rst", "maps/index.rst", "maps/kept.rst", "maps/gone.rst"):
        (pages / page).write_text("", "utf-8")
    (scripts / "maps" / "kept.py").write_text("", "utf-8")
    gallery.remove_stale_pages(pages, scripts)
    left = {page.relative_to(pages).as_posix() for page in pages.rglob("*")}
    assert left == {"index.rst", "maps", "maps/index.rst", "maps/kept.rst"}
