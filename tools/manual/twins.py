"""Twins: each picture of the manual on light and on dark paper, neither with a ground of its own.

A script draws twice and computes once: what its public functions return the first time is given
again the second time. A page shows the picture that fits its theme.
"""

import re
from collections import defaultdict, deque
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import replace
from functools import reduce, wraps
from inspect import isfunction, ismodule
from pathlib import Path
from typing import Any

from docutils import nodes
from sphinx.application import Sphinx

from rocksteady.show.style import palette
from rocksteady.show.style.tokens import Inks

LIGHT_ONLY, DARK_ONLY = "only-light", "only-dark"
"""Classes by which the theme shows a picture, or does not."""

DARK_END = "_dark"
"""What the name of a picture on dark paper has after that of its twin."""
PAPER = "Paper"
"""Name of the text in a PNG that says on which paper it is drawn."""
USED = re.compile(r"\brs\.((?:\w+\.)*\w+)")
CYCLE = ("motion", "base", "impact", "risk", "ink", "quiet")
"""Roles of the colours C0 to C5 of Matplotlib in a script, for the lines that it draws itself."""


def paper(inks: Inks) -> dict[str, Any]:
    """Return the settings of Matplotlib with which a page of the manual is the paper."""
    from cycler import cycler

    colours = cycler(color=[getattr(inks, role) for role in CYCLE])
    return {**palette.in_colours(_page_of(inks)), "axes.prop_cycle": colours}


@contextmanager
def on_paper(inks: Inks, *, dpi: float | None = None) -> Iterator[None]:
    """Make a page of the manual the paper of the house style too, inside a ``with`` block.

    Films and the pictures of commands are drawn in it, whatever the settings of Matplotlib are.
    """
    with palette.on_paper(_page_of(inks), **({"savefig_dpi": dpi} if dpi else {})):
        yield


def _page_of(inks: Inks) -> Inks:
    return replace(inks, paper=inks.page)


def dark_twin(picture: Path) -> Path:
    """Return where the twin on dark paper of a picture lies.

    Examples
    --------
    >>> dark_twin(Path("images/map.png")).name
    'map_dark.png'
    """
    return picture.with_stem(picture.stem + DARK_END)


def save(figure: Any, file: Path, source: str) -> None:
    """Save a figure without its ground, and with the name of what has drawn it."""
    with without_ground(figure):
        metadata = {"Software": "rocksteady", "Source": source}
        figure.savefig(file, facecolor="none", metadata=metadata)


@contextmanager
def without_ground(figure: Any) -> Iterator[None]:
    """Take the ground of a figure from its axes inside a ``with`` block."""
    ground = figure.get_facecolor()
    axes = [each for each in figure.axes if each.get_facecolor() == ground]
    for each in axes:
        each.set_facecolor("none")
    try:
        yield
    finally:
        for each in axes:
            each.set_facecolor(ground)


class Memory:
    """Results of the public functions that a script uses, which it gets again when run again."""

    def __init__(self) -> None:
        """Begin with nothing."""
        self._results: dict[str, deque[Any]] = defaultdict(deque)
        self._originals: list[tuple[Any, str, Any]] = []
        self._inside = self._again = False

    def listen(self, source: str) -> None:
        """Forget all results, and keep those of each public function that a source names."""
        import rocksteady

        self._results.clear()
        for name in set(USED.findall(source)):
            *modules, own = name.split(".")
            try:
                holder: Any = reduce(getattr, modules, rocksteady)
                thing = getattr(holder, own)
            except AttributeError:  # a method of a class, or no name at all
                continue
            if (
                ismodule(holder)
                and isfunction(thing)
                and "plots" not in modules
                and not hasattr(thing, "remembers")
            ):
                self._originals.append((holder, own, thing))
                setattr(holder, own, self._remembering(name, thing))

    def _remembering(self, name: str, function: Callable[..., Any]) -> Callable[..., Any]:
        @wraps(function)
        def call(*args: Any, **kwargs: Any) -> Any:
            if self._again and self._results[name]:
                return self._results[name].popleft()
            if self._again or self._inside:
                return function(*args, **kwargs)
            self._inside = True
            try:
                result = function(*args, **kwargs)
            finally:
                self._inside = False
            self._results[name].append(result)
            return result

        call.remembers = True  # type: ignore[attr-defined]
        return call

    @contextmanager
    def again(self) -> Iterator[None]:
        """Give the results again inside a ``with`` block, in the order in which they came."""
        self._again = True
        try:
            yield
        finally:
            self._again = False

    def restore(self) -> None:
        """Put the functions back."""
        for holder, name, function in self._originals:
            setattr(holder, name, function)
        self._originals.clear()
        self._results.clear()


def paper_of(file: Path) -> str | None:
    """Return the paper that a picture of a cell names, "light" or "dark"; None of other files."""
    from PIL import Image

    if file.suffix != ".png" or not file.is_file():
        return None
    with Image.open(file) as picture:
        text: str | None = picture.info.get(PAPER)
    return text


def show_twins(app: Sphinx, document: nodes.document) -> None:
    """Give pictures that have twins their classes, and put the twins of files behind them."""
    for output in document.findall(nodes.container):
        if output.get("nb_element") == "cell_code_output":
            pair([(each, _file(app, each)) for each in output.findall(nodes.image)])
    for picture in list(document.findall(nodes.image)):
        if dark_twin(_file(app, picture)).is_file():
            twin = picture.deepcopy()
            twin["uri"] = str(dark_twin(Path(picture["uri"])))
            picture["classes"].append(LIGHT_ONLY)
            twin["classes"].append(DARK_ONLY)
            picture.parent.insert(picture.parent.index(picture) + 1, twin)


def _file(app: Sphinx, picture: nodes.image) -> Path:
    """Return the file of a picture of the page that is being read."""
    return Path(app.env.relfn2path(picture["uri"])[1])


def pair(pictures: list[tuple[nodes.image, Path]]) -> None:
    """Give the pictures of a cell their classes, where each has a twin."""
    on: dict[str | None, list[nodes.image]] = defaultdict(list)
    for picture, file in pictures:
        on[paper_of(file)].append(picture)
    if len(on["light"]) == len(on["dark"]):
        for paper, look in (("light", LIGHT_ONLY), ("dark", DARK_ONLY)):
            for picture in on[paper]:
                picture["classes"].append(look)
    else:  # some are drawn on white, whatever the paper
        for picture in on["dark"]:
            picture.parent.remove(picture)


def setup(app: Sphinx) -> dict[str, bool]:
    """Connect the change to pages that are read, before Sphinx collects their pictures."""
    app.connect("doctree-read", show_twins, priority=100)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
