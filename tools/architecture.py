"""Draw `docs/images/architecture.png`, and write the table below it, from the package's imports.

The order of layers and rooms is that of the contracts in `pyproject.toml`, the words are the first
sentences of the folders' docstrings, and all else follows from the imports. A room is a folder of a
layer. Run by `make architecture`.
"""

import ast
import re
import tomllib
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from graphlib import TopologicalSorter
from itertools import pairwise
from pathlib import Path
from typing import TYPE_CHECKING, Any

import grimp

from rocksteady.show.style import palette
from rocksteady.show.style.tokens import DARK, LIGHT, Inks
from tools.manual import images, twins

if TYPE_CHECKING:
    from matplotlib.figure import Figure

ROOT = Path(__file__).parents[1]
SOURCE = ROOT / "src" / "rocksteady"
PAGE = ROOT / "docs" / "reference" / "folders.md"
PICTURE = ROOT / "docs" / "images" / "architecture.png"
NAMESPACE = "rocksteady"
EXPORTS = "The public names, imported from where they are defined when they are first used."
BEGIN, END = "<!-- begin: make architecture -->\n\n", "\n<!-- end -->\n"

Edges = frozenset[tuple[str, str]]
"""Pairs of a name and one that it imports."""


# ----------------------------------------------------------------------------------- the tree


@dataclass(frozen=True)
class Layer:
    """A layer: a folder with its rooms, a module, or the namespace.

    Parameters
    ----------
    name
        Its name.
    sentence
        What it answers.
    rooms
        Names of its folders, high to low.
    edges
        Which of its rooms imports which.
    """

    name: str
    sentence: str
    rooms: tuple[str, ...]
    edges: Edges


@dataclass(frozen=True)
class Tree:
    """The package as the picture shows it.

    Parameters
    ----------
    layers
        High to low; the namespace just above the highest layer that it exports names from.
    edges
        Which layer imports which.
    """

    layers: tuple[Layer, ...]
    edges: Edges

    def __str__(self) -> str:
        """Return all that the picture depends on, which is kept in its file."""
        return "\n".join(
            [f"{layer.name}: {layer.sentence}" for layer in self.layers]
            + [f"{layer.name}/{room}" for layer in self.layers for room in layer.rooms]
            + [f"{user} -> {used}" for user, used in sorted(self.edges)]
            + [
                f"{layer.name}/{user} -> {layer.name}/{used}"
                for layer in self.layers
                for user, used in sorted(layer.edges)
            ]
        )


def place_of(module: str) -> str:
    """Return the room that a module lies in, as ``dynamics/orbits``, or else its layer.

    Examples
    --------
    >>> place_of("rocksteady.dynamics.orbits.search"), place_of("rocksteady.dynamics.parameters")
    ('dynamics/orbits', 'dynamics')
    """
    layer, room, *_ = [*module.split(".")[1:], "", ""]
    if not layer or (SOURCE / f"{layer}.pyi").is_file():  # a public module passes names on
        return NAMESPACE
    is_room = room and (SOURCE / layer / room / "__init__.py").is_file()
    return f"{layer}/{room}" if is_room else layer


def imports() -> Edges:
    """Return which place imports which, imports inside functions included."""
    graph = grimp.build_graph(NAMESPACE, cache_dir=None)
    pairs = {
        (place_of(user), place_of(used))
        for user in graph.modules - {f"{NAMESPACE}.__main__"}
        for used in graph.find_modules_directly_imported_by(user)
    }
    return frozenset((user, used) for user, used in pairs if user != used)


def order_in(container: str) -> list[str]:
    """Return what a package holds, high to low, from its contract of import-linter.

    Nothing where it has none; names of a contract that do not exist yet are left out.
    """
    settings = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))
    rows = [
        row
        for contract in settings["tool"]["importlinter"]["contracts"]
        if contract.get("containers") == [container]
        for row in contract["layers"]
    ]
    below = "/".join(container.split(".")[1:])
    names = [name.strip(" ()") for row in rows for name in re.split("[|:]", row)]
    return [name for name in names if file_of(f"{below}/{name}".lstrip("/")).is_file()]


def file_of(place: str) -> Path:
    """Return the file whose docstring says what a folder or module answers."""
    folder = SOURCE / place
    return folder / "__init__.py" if folder.is_dir() else folder.with_suffix(".py")


def sentence_of(place: str) -> str:
    """Return the first sentence of the docstring of a folder or module."""
    tree = ast.parse(file_of(place).read_text(encoding="utf-8"))
    return first_sentence(ast.get_docstring(tree) or "")


def first_sentence(text: str) -> str:
    """Return the first sentence of a text, on one line; initials of names end none.

    Examples
    --------
    >>> first_sentence("W. K. Tso, 1989: every figure.  The rest.")
    'W. K. Tso, 1989: every figure.'
    """
    words = " ".join(text.split())
    found = re.match(r".*?(?<!\b[A-Z])\.(?= |$)", words)
    return found[0] if found else ""


def read_tree() -> Tree:
    """Return the tree of the package as it is now."""
    edges = imports()
    between = {(user.partition("/")[0], used.partition("/")[0]) for user, used in edges}
    above = frozenset((user, used) for user, used in between if user != used)
    names = order_in(NAMESPACE)
    exported = [names.index(used) for user, used in above if user == NAMESPACE]
    names.insert(min(exported), NAMESPACE)
    layers = []
    for name in names:
        inside = frozenset(
            (user.partition("/")[2], used.partition("/")[2])
            for user, used in edges
            if user.startswith(f"{name}/") and used.startswith(f"{name}/")
        )
        there = {folder.parent.name for folder in (SOURCE / name).glob("*/__init__.py")}
        held = [room for room in order_in(f"{NAMESPACE}.{name}") if room in there]
        rooms = (*held, *sorted(there - {*held}))
        said = EXPORTS if name == NAMESPACE else sentence_of(name)
        layers.append(Layer(name, said, rooms, inside))
    return Tree(tuple(layers), above)


# ---------------------------------------------------------------------------------- the order


def direct(names: Iterable[str], edges: Edges) -> dict[str, set[str]]:
    """Return what each name imports, the names in an order in which that comes first."""
    found = {name: {used for user, used in edges if user == name} for name in names}
    return {name: found[name] for name in TopologicalSorter(found).static_order()}


def levels(names: Iterable[str], edges: Edges) -> dict[str, int]:
    """Return the level of each name: 0 where it imports no other, else one above all it imports."""
    level: dict[str, int] = {}
    for name, found in direct(names, edges).items():
        level[name] = 1 + max((level[used] for used in found), default=-1)
    return level


def reduced(names: Iterable[str], edges: Edges) -> Edges:
    """Return the edges from which all others follow: no path through a third name replaces them."""
    below: dict[str, set[str]] = {}
    for name, found in direct(names, edges).items():
        below[name] = found.union(*(below[used] for used in found))
    return frozenset(
        (user, used)
        for user, used in edges
        if not any((user, third) in edges and used in below[third] for third in below)
    )


# ---------------------------------------------------------------------------------- the table


def folders(tree: Tree) -> list[str]:
    """Return all folders and public modules, high to low, each above the folders inside it."""
    found = []
    for layer in tree.layers:
        if layer.name == NAMESPACE:
            continue
        found.append(layer.name)
        for room in layer.rooms:
            inside = (SOURCE / layer.name / room).rglob("__init__.py")
            found += sorted(file.parent.relative_to(SOURCE).as_posix() for file in inside)
    return found


def table(tree: Tree) -> str:
    """Return the table of the page: each folder and what it answers."""
    rows = ["| folder | what it answers |", "|---|---|"]
    for place in folders(tree):
        path = file_of(place)
        target = path.parent if path.name == "__init__.py" else path
        link = f"[`{place}`](../../{target.relative_to(ROOT).as_posix()})"
        said = sentence_of(place).replace("``", "`").replace("|", r"\|")
        rows.append(f"| {link if '/' in place else f'**{link}**'} | {said} |")
    return "\n".join(rows) + "\n"


def written_into(page: str, rows: str) -> str:
    """Return a page with the table between its two marks."""
    begin, end = page.index(BEGIN) + len(BEGIN), page.index(END)
    return f"{page[:begin]}{rows}{page[end:]}"


# -------------------------------------------------------------------------------- the picture

WIDTH, MARGIN, PAD = 7.0, 0.06, 0.1
"""Of the picture, around it, and inside a layer; inches, as all lengths below."""
NAME, ROOM, WORDS = 8.0, 7.0, 6.6
"""Sizes of text in points: names of layers, names of rooms, all else."""
HEAD, ROW, BETWEEN, KEY = 0.22, 0.24, 0.045, 0.36
"""Heights: of a layer's line of words, of a row of rooms, between two layers, of the key."""
BOX, HIGH, GAP = 0.7, 0.18, 0.12
"""Least width and height of a room's box, and the distance to the next."""
LANE = 0.085
"""Between two lines at the right."""
ROOMS = 5.6
"""Width that rooms may take before the lines at the right."""
KEYS = (
    "At the right: a layer (▲) uses those with a dot (●) on its line.",
    (
        "Inside a layer: an arrow goes from a folder to one that uses it; "
        "what follows from other arrows is left out."
    ),
)


def spots(layer: Layer) -> dict[str, tuple[int, int]]:
    """Return column and row of each room, and of each place where an arrow passes a column.

    The columns are the levels, low to high. An arrow that passes a column takes a row of it, as a
    room does, under the name ``user<used<column``.
    """
    level = levels(layer.rooms, layer.edges)
    columns: list[list[str]] = [[] for _ in range(max(level.values(), default=-1) + 1)]
    for room in layer.rooms:
        columns[level[room]].append(room)
    for user, used in sorted(reduced(layer.rooms, layer.edges)):
        for k in range(level[used] + 1, level[user]):
            columns[k].append(passing(user, used, k))
    return {name: (k, row) for k, column in enumerate(columns) for row, name in enumerate(column)}


def passing(user: str, used: str, column: int) -> str:
    """Return the name of the place where an arrow passes a column."""
    return f"{user}<{used}<{column}"


def draw(tree: Tree, inks: Inks = LIGHT) -> "Figure":
    """Return the picture: layers one below the other, their rooms from left to right."""
    from matplotlib.figure import Figure

    tops, tall, at = [], [], MARGIN
    for layer in tree.layers:
        rows = 1 + max((row for _, row in spots(layer).values()), default=-1)
        tops.append(at)
        tall.append(HEAD + ROW * rows + (0.04 if rows else 0.0))
        at += tall[-1] + BETWEEN
    height = at + KEY
    with twins.on_paper(inks), palette.style():
        figure = Figure(figsize=(WIDTH, height))
        figure.set_layout_engine("none")
        axes = figure.add_axes((0.0, 0.0, 1.0, 1.0))
        axes.set(xlim=(0.0, WIDTH), ylim=(height, 0.0))
        axes.set_axis_off()
        for layer, top, band in zip(tree.layers, tops, tall, strict=True):
            _draw_layer(axes, layer, top, band, inks)
        _draw_lanes(axes, tree, [top + 0.5 * HEAD for top in tops], inks)
        for k, words in enumerate(KEYS):
            _write(axes, MARGIN + PAD, at + 0.11 + 0.15 * k, words, color=inks.quiet)
    return figure


def _draw_layer(axes: Any, layer: Layer, top: float, tall: float, inks: Inks) -> None:
    """Draw a layer: its band, its words, its rooms and the arrows between them."""
    from matplotlib.patches import Rectangle

    look: dict[str, Any] = {"fc": inks.hair, "ec": inks.hair, "lw": 0.0}
    if layer.name == NAMESPACE:
        look = {"fc": inks.page, "ec": inks.edge, "lw": 0.6, "ls": (0, (3, 2))}
    axes.add_patch(Rectangle((MARGIN, top), WIDTH - 2.0 * MARGIN, tall, **look))
    left, line = MARGIN + PAD, top + 0.5 * HEAD
    _write(axes, left, line, layer.name, size=NAME, weight="bold")
    _write(axes, left + 0.86, line, layer.sentence, color=inks.quiet)

    wide = _widths(layer)
    corner = {
        name: (
            left + sum(wide[:column]) + GAP * column,
            top + HEAD + ROW * row + 0.5 * (ROW - HIGH),
        )
        for name, (column, row) in spots(layer).items()
    }
    box = {name: wide[column] for name, (column, _) in spots(layer).items()}
    level = levels(layer.rooms, layer.edges)
    for user, used in sorted(reduced(layer.rooms, layer.edges)):
        between = [passing(user, used, k) for k in range(level[used] + 1, level[user])]
        stops = [corner[name] for name in (used, *between, user)]
        column, row = spots(layer)[used]
        rows = sum(other == column for other, _ in spots(layer).values())
        shift = (1 + row) / (1 + rows)  # arrows from other rows turn elsewhere
        places = (used, *between, user)
        xs, ys = [stops[0][0] + box[used]], [stops[0][1]]
        for (here, there), ((x, y), (next_x, next_y)) in zip(
            pairwise(places), pairwise(stops), strict=True
        ):
            turn = x + box[here] + shift * GAP
            xs += [turn, turn, next_x + box[there]]
            ys += [y, next_y, next_y]
        xs[-1] = stops[-1][0]
        middle = [y + 0.5 * HIGH for y in ys]
        axes.plot(xs, middle, color=inks.ink, lw=0.9, solid_joinstyle="miter")
        axes.plot(xs[-1] - 0.028, middle[-1], ">", color=inks.ink, ms=3.4, mew=0.0)
    for room in layer.rooms:
        x, y = corner[room]
        look = {"fc": inks.page, "ec": inks.ink, "lw": 0.6, "zorder": 3, "gid": "room"}
        axes.add_patch(Rectangle((x, y), box[room], HIGH, **look))
        look = {"size": ROOM, "ha": "center", "zorder": 4, "gid": "room"}
        _write(axes, x + 0.5 * box[room], y + 0.5 * HIGH, room, **look)


def _widths(layer: Layer) -> list[float]:
    """Return the width of each column: one for all, or if that is too wide, its own."""
    columns: dict[int, float] = {}
    for name, (column, _) in spots(layer).items():
        words = 0.1 + _width(name) if name in layer.rooms else 0.0
        columns[column] = max(columns.get(column, 0.0), words)
    alike = max([BOX, *columns.values()])
    if (alike + GAP) * len(columns) <= ROOMS:
        return [alike] * len(columns)
    return [columns[column] for column in sorted(columns)]


def _draw_lanes(axes: Any, tree: Tree, heights: Sequence[float], inks: Inks) -> None:
    """Draw a line for each layer that imports others, up to it from those that it imports."""
    height = {layer.name: at for layer, at in zip(tree.layers, heights, strict=True)}
    users = [name for name in height if any(user == name for user, _ in tree.edges)]
    for k, name in enumerate(users):
        x = WIDTH - MARGIN - PAD - LANE * k
        dots = [height[used] for user, used in tree.edges if user == name]
        axes.plot([x, x], [height[name], max(dots)], color=inks.ink, lw=0.9)
        axes.plot([x] * len(dots), dots, "o", color=inks.ink, ms=3.4, mew=0.0)
        axes.plot(x, height[name], "^", color=inks.ink, ms=4.6, mew=0.0)


def _write(axes: Any, x: float, y: float, words: str, **look: Any) -> None:
    """Write a line of text, centred at a height; a dollar sign begins no formula."""
    plain = {"size": WORDS, "va": "center_baseline", "parse_math": False}
    axes.text(x, y, words, **plain | look)


def _width(words: str) -> float:
    """Return the width of the name of a room in inches."""
    from matplotlib.font_manager import FontProperties
    from matplotlib.textpath import TextPath

    look = FontProperties(family="DejaVu Sans")
    return float(TextPath((0.0, 0.0), words, size=ROOM, prop=look).get_extents().width) / 72.0


if __name__ == "__main__":
    now = read_tree()
    for inks, file in ((LIGHT, PICTURE), (DARK, twins.dark_twin(PICTURE))):
        draw(now, inks).savefig(file, dpi=175.0, metadata={"Description": str(now)})
        images.make_small(file, inks.page, "tools/architecture.py")
    kept = PAGE.read_text(encoding="utf-8")
    PAGE.write_text(written_into(kept, table(now)), encoding="utf-8")
    print(f"written: {PICTURE.relative_to(ROOT)} and the table in {PAGE.relative_to(ROOT)}")
