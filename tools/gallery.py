"""Draw every kind of picture on one page: light, dark, in a column of a journal, and in grey.

Beside them stand a terminal, a report and the explorer, wide and as on a phone, and the words of
the colours. Run by `make gallery`; it is there to be looked at, when anything that is drawn has
changed.
"""

import contextlib
import functools
import html
import inspect
import io
import runpy
import sys
from base64 import b64encode
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import cache, partial
from pathlib import Path
from typing import Any
from unittest.mock import patch

import matplotlib as mpl

import rocksteady as rs
from rocksteady.show.export.files import figure_bytes
from rocksteady.show.style import palette
from rocksteady.show.style.page import Page
from rocksteady.show.style.tokens import DARK, LIGHT, Inks, meanings
from tests.public.calls import calls, close_pictures, room
from tests.show.all_pictures import FIGURES
from tests.show.drawn_figures import makers

OUT = Path("out/gallery").absolute()
EXAMPLES = Path(__file__).parents[1] / "examples"
WHOLE = {
    "calibration": "plot_test_ladders",
    "back analysis": "plot_back_analysis",
    "predictions": "plot_predictions",
    "restitution_fit": "plot_restitution",
    "facade check": "plot_facade_capacity",
    "edge": "plot_edge_state",
    "fates": "plot_fate_basins",
    "curves": "plot_bifurcation_curves",
    "scales": "plot_overturning_scales",
    "kicks": "plot_fatal_kicks",
}
"""The plot that has the thing of a whole figure first among its arguments."""
COLUMN = 84.0
"""Width of a column of a journal [mm]."""
HEAD = """<!doctype html><html lang="en"><meta charset="utf-8"><title>Every picture</title><style>
body {{ font: 14px/1.5 system-ui, sans-serif; margin: 20px;
  background: {light.page}; color: {light.ink} }}
section {{ border-top: 1px solid {light.hair}; padding: 12px 0 }}
h2 {{ font-size: 17px; margin: 0 0 8px }}
div {{ display: flex; flex-wrap: wrap; gap: 12px; align-items: flex-start }}
img {{ width: 600px; background: {light.paper} }}
img.dark {{ background: {dark.paper} }} img.column {{ width: 318px }}
img.grey {{ filter: grayscale(1) }} iframe {{ height: 844px; border: 1px solid {light.edge} }}
pre {{ padding: 12px; background: {light.paper}; margin: 0 }}
pre.dark {{ background: {dark.page}; color: {dark.ink} }}
i {{ display: inline-block; width: 28px; height: 20px; border: 1px solid {light.edge} }}
</style>
"""
SCREENS = (
    "simulate --width-m 0.4 --height-m 2 --accel-g 0.4 --freq-hz 2",
    "steady --width-m 0.4 --height-m 2 --accel-g 0.4 --freq-hz 2",
    "overturn --width-m 0.4 --height-m 2 --pulse one-sine --freq-hz 2",
    "screens --width-m 0.6 --height-m 2 --pga-g 0.4 --pgv-m-s 0.4",
)
"""Commands whose screens are shown."""
PAGES = {
    "report/report.html": "assess --example --out report --force",
    "explorer.html": "explore --no-browser --out explorer.html --force",
}
"""Pages that are shown, wide and as on a phone, and the commands that write them."""
WIDE, PHONE = 1280, 390
"""Widths of a window and of a phone [px]."""


@dataclass(frozen=True)
class Asked:
    """A plot that an example draws, to be drawn again on other paper."""

    name: str
    """Of the plot, and of the example."""
    function: Callable[..., Any]
    given: dict[str, Any]
    """Its arguments, without the axes."""

    def __call__(self, page: Page) -> Any:
        """Return a figure of the plot for a page."""
        with page.figure(6.4, 4.2, "") as figure:
            self.function(**self.given, ax=figure.add_subplot())
        return figure


@cache
def asked(folder: str = "") -> list[Asked]:
    """Run the examples, or those of one folder, and return the plots that they draw."""
    found: list[Asked] = []
    script = EXAMPLES

    def noted(function: Callable[..., Any]) -> Callable[..., Any]:
        @functools.wraps(function)
        def note(*arguments: Any, **options: Any) -> Any:
            given = inspect.signature(function).bind(*arguments, **options).arguments
            given.pop("ax", None)
            count = sum(each.function is function for each in found) + 1
            found.append(Asked(f"{function.__name__} {count}: {script.stem}", function, given))
            return function(*arguments, **options)

        return note

    names = [name for name in rs.plots.__all__ if name != "animate"]
    notes: dict[str, Any] = {name: noted(getattr(rs.plots, name)) for name in names}
    with patch.multiple(rs.plots, **notes):
        for script in sorted((EXAMPLES / folder).rglob("*.py")):
            runpy.run_path(str(script))
            close_pictures()
    return found


def pictures() -> Iterator[tuple[str, Callable[[Page], Any]]]:
    """Yield the name of each picture, and what draws its figure for a page.

    Their data are those of the examples: of the plots, and of whole figures of the same things.
    What no example draws has small data of its own.
    """
    for name, draw in makers().items():
        yield name, draw
    for name, draw in FIGURES.items():
        yield name, partial(on_named, draw, next(e for e in asked() if WHOLE[name] in e.name))
    yield from ((each.name, each) for each in asked())
    drawn = {each.function for each in asked()}
    for label, call in calls().items():
        plots = call.function.__module__.startswith("rocksteady.show.plots")
        if plots and call.function not in drawn:
            yield label, Asked(label, call.function, call.arguments)


def on_named(draw: Callable[..., Any], of: Asked, page: Page) -> Any:
    """Return a whole figure of the thing that an example plots."""
    return draw(next(iter(of.given.values())), page=page)


def shown(draw: Callable[[Page], Any]) -> Iterator[str]:
    """Yield a picture on light and dark paper, wide and in a column, as HTML."""
    for inks in (LIGHT, DARK):
        for page in (Page(), Page(width_mm=COLUMN)):
            with palette.on_paper(inks):
                data = figure_bytes(draw(page), "png")
            look = f"{'dark ' if inks.dark else ''}{'column' if page.width_mm else ''}"
            source = f"data:image/png;base64,{b64encode(data).decode()}"
            yield f'<img class="{look}" src="{source}">'
            if page.width_mm and not inks.dark:
                yield f'<img class="column grey" src="{source}">'
            close_pictures()


def screen(words: str) -> str:
    """Return what a command prints."""
    from rocksteady.cli.entry import main

    printed = io.StringIO()
    with contextlib.redirect_stdout(printed), contextlib.suppress(SystemExit):
        sys.argv = ["rocksteady", *words.split()]
        main()
    assert printed.getvalue(), words
    return f"$ rocksteady {words}\n{printed.getvalue()}"


def pages() -> Iterator[str]:
    """Write each page beside the gallery, and yield it, wide and as on a phone, as HTML."""
    with contextlib.chdir(OUT):
        for file, words in PAGES.items():
            screen(words)
            assert Path(file).is_file(), file
            frames = (f'<iframe src="{file}" width="{width}"></iframe>' for width in (WIDE, PHONE))
            yield f"<section><h2>{file}</h2><div>{''.join(frames)}</div></section>"


def swatches(inks: Inks) -> Iterator[str]:
    """Yield the colour of each role with its meaning, as HTML."""
    for name, means in meanings():
        colours = getattr(inks, name)
        for colour in (colours,) if isinstance(colours, str) else colours:
            yield f'<i style="background:{colour}"></i> '
        yield f"{name}: {means}<br>"


def main(only: str = "") -> None:
    """Write the page, or only the pictures whose name has a text in it."""
    mpl.use("agg")
    parts = [HEAD.format(light=LIGHT, dark=DARK)]
    OUT.mkdir(parents=True, exist_ok=True)
    with contextlib.chdir(room()):
        for name, draw in pictures():
            if only in name:
                parts += [
                    f"<section><h2>{html.escape(name)}</h2><div>",
                    *shown(draw),
                    "</div></section>",
                ]
        if not only:
            texts = [html.escape(screen(words)) for words in SCREENS]
            parts += [
                f"<section><div><pre>{t}</pre><pre class=dark>{t}</pre></div></section>"
                for t in texts
            ]
            parts += [*pages(), "<section>", *swatches(LIGHT), *swatches(DARK), "</section>"]
    file = OUT / "index.html"
    file.write_text("\n".join(parts), encoding="utf-8")
    print(f"written: {file}")


if __name__ == "__main__":
    main(*sys.argv[1:2])
