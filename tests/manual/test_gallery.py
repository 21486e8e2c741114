"""The gallery: short scripts of public names, which together show every plot of the package."""

import ast
import inspect
import re
from operator import attrgetter
from pathlib import Path
from typing import Any

import matplotlib as mpl
import matplotlib.pyplot as plt
from PIL import Image
from sphinx_gallery.gen_gallery import DEFAULT_GALLERY_CONF  # type: ignore[import-untyped]

import rocksteady as rs
from rocksteady.show.style import palette
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


def test_the_style_is_that_of_the_package_whatever_a_script_before_has_set() -> None:
    before = dict(mpl.rcParams)
    try:
        mpl.rcParams["axes.facecolor"] = "black"
        plt.figure()
        gallery.set_style({}, "")
        assert not plt.get_fignums()
        assert mpl.rcParams["axes.facecolor"] == "white"
        assert mpl.rcParams["font.size"] == palette.STYLE["font.size"]
        assert list(mpl.rcParams["axes.prop_cycle"].by_key()["color"]) == list(palette.LINES)
    finally:
        mpl.rcParams.update(before)


def test_guides_show_pictures_of_scripts_that_there_are() -> None:
    assert set(gallery.GUIDES.values()) <= set(SCRIPTS)
    for name in gallery.GUIDES:
        assert (DOCS / "images" / name).is_file()


def test_a_film_becomes_a_small_gif_that_plays(tmp_path: Path) -> None:
    block = rs.Block.rectangle(width=0.5, height=2.0)
    run = rs.simulate(block, rs.Still(), start=rs.State(angle=0.8, velocity=0.0))
    film = rs.plots.animate(run, span=(0.0, 0.5), fps=10)
    paths = iter([str(tmp_path / "sphx_glr_film_001.png")])
    conf = {**DEFAULT_GALLERY_CONF, "src_dir": str(tmp_path), "image_srcset": []}
    conf["matplotlib_animations"] = (False, None)
    variables: dict[str, Any] = {
        "example_globals": {"film": film, "run": run},
        "image_path_iterator": paths,
        "src_file": str(SCRIPTS["histories/film.py"]),
    }
    text = gallery.save_pictures(None, variables, conf)
    assert "sphx_glr_film_001.gif" in text
    assert ":alt: How does a statue fall?\n" in text
    with Image.open(tmp_path / "sphx_glr_film_001.gif") as picture:
        assert getattr(picture, "n_frames", 1) > 1
    assert not gallery.save_pictures(None, {**variables, "example_globals": {"run": run}}, conf)


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
