"""The gallery: the order of its sections, the style of its pictures, and its films."""

import ast
import runpy
import shutil
from collections.abc import Mapping
from contextlib import ExitStack
from pathlib import Path
from typing import Any, NamedTuple, Self

from rocksteady.show.film.animation import Film
from rocksteady.show.film.gif import save_gif
from rocksteady.show.style import palette
from rocksteady.show.style.tokens import DARK, LIGHT, Inks
from tools.manual import twins

ORDER = ("steady", "histories", "orbits", "maps", "overturning", "earthquakes", "risk")
"""Folders of examples/, as the gallery shows them."""
BESIDE = ("ipynb", "json", "md5", "py", "zip")
"""Endings of what sphinx-gallery writes beside a page."""
EXAMPLES = Path(__file__).parents[2] / "examples"
SIZE = (7.36, 4.2)
"""Of a figure [inches]: at DPI as wide as the column of a page."""
DPI = 100.0
MEMORY = twins.Memory()
PAPER = ExitStack()
"""What a script has computed and its paper, until its pictures are saved."""


def remove_stale_pages(folder: Path, examples: Path = EXAMPLES) -> None:
    """Remove the pages of scripts that are gone, which sphinx-gallery leaves behind."""
    for page in folder.rglob("*.rst"):
        script = examples / page.relative_to(folder).with_suffix(".py")
        if not script.is_file() and page.name != "index.rst":
            page.unlink()


def prepare(_conf: Mapping[str, Any], name: str) -> None:
    """Prepare Matplotlib and the public functions for a script of a name, which is drawn twice."""
    PAPER.close()
    PAPER.enter_context(twins.on_paper(LIGHT))
    set_style(LIGHT)
    MEMORY.listen("".join(each.read_text(encoding="utf-8") for each in EXAMPLES.rglob(name)))


def set_style(inks: Inks) -> None:
    """Set Matplotlib to the house style, in the width of a page, whose ground is the paper."""
    import matplotlib as mpl
    import matplotlib.pyplot as plt

    plt.close("all")
    mpl.rcdefaults()
    size = {"figure.figsize": SIZE, "figure.dpi": DPI, "savefig.dpi": 2.0 * DPI}
    settings: Any = mpl.rcParams  # whose keys are a type of 300 literals
    settings.update({**palette.STYLE, **size, **twins.paper(inks)})


def save_pictures(_block: Any, variables: dict[str, Any], conf: Mapping[str, Any]) -> str:
    """Save the films and the figures of a script twice, and return the text that shows them."""
    script = Path(variables["src_file"])
    drawn = Drawn.of(variables["example_globals"])
    numbered = variables["image_path_iterator"]
    paths = [Path(next(numbered)).with_suffix(ending) for ending in drawn.endings]
    drawn.save(paths, script)
    PAPER.close()
    if paths:
        with MEMORY.again():
            draw_on(DARK, script, [twins.dark_twin(path) for path in paths])
        _save_dark_thumbnail(twins.dark_twin(paths[0]), script, conf["thumbnail_size"])
    MEMORY.restore()
    question = title_of(script)
    places = ("/" + path.relative_to(conf["src_dir"]).as_posix() for path in paths)
    options = f"   :alt: {question}\n   :class: sphx-glr-single-img\n   :loading: lazy\n"
    return "\n".join(f".. image:: {place}\n{options}" for place in places)


def _save_dark_thumbnail(picture: Path, script: Path, size: tuple[int, int]) -> None:
    """Save the twin of the small picture that sphinx-gallery makes of the first one."""
    from sphinx_gallery.utils import scale_image  # type: ignore[import-untyped]

    name = f"sphx_glr_{script.stem}_thumb{twins.DARK_END}{picture.suffix}"
    target = picture.parent / "thumb" / name
    target.parent.mkdir(parents=True, exist_ok=True)
    if picture.suffix == ".gif":  # as sphinx-gallery does
        shutil.copyfile(picture, target)
    else:
        scale_image(picture, target, *size)


class Drawn(NamedTuple):
    """What a script has drawn."""

    films: list[Any]
    figures: list[Any]

    @classmethod
    def of(cls, names: Mapping[str, Any]) -> Self:
        """Return the films among the names of a script, and its figures that are open."""
        import matplotlib.pyplot as plt
        from matplotlib.animation import FuncAnimation

        films = [value for value in names.values() if isinstance(value, FuncAnimation)]
        return cls(films, [plt.figure(number) for number in plt.get_fignums()])

    @property
    def endings(self) -> list[str]:
        """Return the endings of their files."""
        return [".gif"] * len(self.films) + [".png"] * len(self.figures)

    def save(self, files: list[Path], script: Path) -> None:
        """Save the films and the figures to files, and close them."""
        import matplotlib.pyplot as plt

        source = script.relative_to(EXAMPLES.parent).as_posix()
        for film, file in zip(self.films, files, strict=False):
            save_gif(film_behind(film), file)
        for figure, file in zip(self.figures, files[len(self.films) :], strict=True):
            twins.save(figure, file, source)
        plt.close("all")


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


def draw_on(inks: Inks, script: Path, files: list[Path]) -> None:
    """Run a script on light or dark paper, and save what it draws to files."""
    import matplotlib as mpl

    mpl.use("agg")
    set_style(inks)
    with twins.on_paper(inks):
        Drawn.of(runpy.run_path(str(script))).save(files, script)
