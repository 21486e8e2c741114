"""The gallery: the order of its sections, the style of its pictures, and its films.

`python -m tools.manual.gallery docs/images` draws those pictures of it again that guides show.
"""

import ast
import re
import runpy
import sys
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from rocksteady.show.film.animation import Film
from rocksteady.show.film.gif import save_gif
from rocksteady.show.style import palette

ORDER = ("steady", "histories", "orbits", "maps", "overturning", "earthquakes", "risk")
"""Folders of examples/, as the gallery shows them."""
BESIDE = ("ipynb", "json", "md5", "py", "zip")
"""Endings of what sphinx-gallery writes beside a page."""
EXAMPLES = Path(__file__).parents[2] / "examples"
GUIDES = {
    "free-rocking.png": "overturning/free_rocking.py",
    "overturning.png": "overturning/windows.py",
    "pulses.png": "overturning/pulses.py",
    "restitution-fit.png": "risk/restitution.py",
    "restitution.png": "overturning/housner.py",
    "spectrum-suite.png": "earthquakes/suite_spectrum.py",
    "spectrum.png": "earthquakes/rocking_spectrum.py",
}
"""Pictures that guides show, each with the script whose one figure it is."""
SIZE = (7.36, 4.2)
"""Of a figure [inches]: at DPI as wide as the column of a page."""
DPI = 100.0


def remove_stale_pages(folder: Path, examples: Path = EXAMPLES) -> None:
    """Remove the pages of scripts that are gone, which sphinx-gallery leaves behind."""
    for page in folder.rglob("*.rst"):
        script = examples / page.relative_to(folder).with_suffix(".py")
        if not script.is_file() and page.name != "index.rst":
            page.unlink()


def set_style(_conf: Mapping[str, Any], _name: str) -> None:
    """Set Matplotlib for a script: the house style on light paper, in the width of a page."""
    import matplotlib as mpl
    import matplotlib.pyplot as plt
    from cycler import cycler

    plt.close("all")
    mpl.rcdefaults()
    size = {"figure.figsize": SIZE, "figure.dpi": DPI, "savefig.dpi": DPI}
    colours = {"axes.prop_cycle": cycler(color=palette.LINES)}
    settings: Any = mpl.rcParams  # whose keys are a type of 300 literals
    settings.update({**palette.STYLE, **size, **colours})


def save_pictures(block: Any, variables: dict[str, Any], conf: Mapping[str, Any]) -> str:
    """Save the films and the figures of a script, and return the text that shows them."""
    from matplotlib.animation import FuncAnimation
    from sphinx_gallery.scrapers import (  # type: ignore[import-untyped]
        figure_rst,
        matplotlib_scraper,
    )

    paths = []
    for value in variables["example_globals"].values():
        if isinstance(value, FuncAnimation):
            path = Path(next(variables["image_path_iterator"])).with_suffix(".gif")
            save_gif(film_behind(value), path)
            paths.append(str(path))
    text: str = figure_rst(paths, conf["src_dir"]) if paths else ""
    text += matplotlib_scraper(block, variables, conf)
    question = title_of(Path(variables["src_file"]))
    return re.sub(r":alt:.*", lambda _: f":alt: {question}", text)


def title_of(script: Path) -> str:
    """Return the first line of the docstring of a script: the question that it answers."""
    text = ast.get_docstring(ast.parse(script.read_text(encoding="utf-8")))
    assert text is not None
    return text.splitlines()[0]


def film_behind(animation: Any) -> Film:
    """Return the film that an animation of `rocksteady.plots.animate` plays."""
    animation._draw_was_started = True  # no warning that nobody has looked at it
    film = animation._func.__self__
    assert isinstance(film, Film)
    return film


def draw(script: Path) -> tuple[list[Any], list[Any]]:
    """Run a script in the style of the gallery and return its figures and its films."""
    import matplotlib as mpl
    import matplotlib.pyplot as plt
    from matplotlib.animation import FuncAnimation

    mpl.use("agg")
    set_style({}, "")
    names = runpy.run_path(str(script))
    films = [value for value in names.values() if isinstance(value, FuncAnimation)]
    return [plt.figure(number) for number in plt.get_fignums()], films


def main(folder: Path) -> None:
    """Draw the pictures that guides show into a folder."""
    folder.mkdir(parents=True, exist_ok=True)
    for name, script in GUIDES.items():
        (figure,), _ = draw(EXAMPLES / script)
        figure.savefig(folder / name, dpi=2.0 * DPI)


if __name__ == "__main__":
    main(Path(*sys.argv[1:2]))
