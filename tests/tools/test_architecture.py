"""The picture of the package: drawn from the imports of now, in an order that they allow."""

import ast
import re
from itertools import combinations, pairwise
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st
from matplotlib.transforms import Bbox
from PIL import Image

from tests.every import every
from tools.architecture import (
    NAMESPACE,
    PAGE,
    PICTURE,
    SOURCE,
    Edges,
    Layer,
    Tree,
    draw,
    first_sentence,
    folders,
    imports,
    levels,
    order_in,
    passing,
    read_tree,
    reduced,
    sentence_of,
    spots,
    table,
    written_into,
)

AGAIN = "run `make architecture`"


@pytest.fixture(scope="module")
def tree() -> Tree:
    return read_tree()


# ------------------------------------------------------------------------- what is committed


def test_the_picture_was_drawn_from_the_tree_as_it_is(tree: Tree) -> None:
    with Image.open(PICTURE) as picture:
        assert picture.info["Description"] == str(tree), AGAIN
        assert picture.width >= 1200


def test_the_table_of_the_page_is_that_of_the_tree_as_it_is(tree: Tree) -> None:
    page = PAGE.read_text(encoding="utf-8")
    assert written_into(page, table(tree)) == page, AGAIN


@pytest.mark.slow
def test_every_folder_of_the_package_has_a_row_and_a_sentence(tree: Tree) -> None:
    listed = folders(tree)
    there = {file.parent.relative_to(SOURCE).as_posix() for file in SOURCE.rglob("__init__.py")}
    assert sorted(listed) == sorted((there - {"."}) | {"arrays", "durable", "errors", "outcomes"})
    for place in listed:
        said = sentence_of(place)
        assert re.fullmatch(r"[A-Z].*\.", said), (place, said)
        assert f"`{place}`" in table(tree)


# ------------------------------------------------------------------------------- the imports


def module_of(file: Path) -> str:
    parts = (NAMESPACE, *file.relative_to(SOURCE).with_suffix("").parts)
    return ".".join(parts).removesuffix(".__init__")


FILES = {module_of(file): file for file in SOURCE.rglob("*.py")}


def parsed_imports() -> set[tuple[str, str]]:
    """Return which module imports which, as the syntax of each file says."""
    found = set()
    for name, file in FILES.items():
        for node in ast.walk(ast.parse(file.read_text(encoding="utf-8"))):
            if isinstance(node, ast.Import):
                found |= {(name, alias.name) for alias in node.names}
            elif isinstance(node, ast.ImportFrom):
                for alias in node.names:
                    inner = f"{node.module}.{alias.name}"
                    found.add((name, inner if inner in FILES else str(node.module)))
    return {(user, used) for user, used in found if used in FILES}


@pytest.mark.slow
def test_the_edges_are_those_that_the_syntax_of_the_files_gives() -> None:
    def place(module: str) -> str:
        folder = FILES[module].parent.relative_to(SOURCE)
        if len(folder.parts) >= 2:
            return "/".join(folder.parts[:2])
        passing = FILES[module].parent == SOURCE and FILES[module].with_suffix(".pyi").exists()
        return folder.name or (not passing and module.partition(".")[2]) or NAMESPACE

    edges = {(place(user), place(used)) for user, used in parsed_imports()}
    assert imports() == {(user, used) for user, used in edges if user not in {used, "__main__"}}


def test_the_order_is_that_of_the_contracts_and_no_import_goes_up(tree: Tree) -> None:
    names = [layer.name for layer in tree.layers]
    assert [name for name in names if name != NAMESPACE] == order_in(NAMESPACE)
    assert all(names.index(user) < names.index(used) for user, used in tree.edges)
    for layer in tree.layers:
        held = order_in(f"{NAMESPACE}.{layer.name}")
        assert not held or [name for name in held if name in layer.rooms] == list(layer.rooms)
        for user, used in layer.edges:
            assert layer.rooms.index(user) < layer.rooms.index(used)


# --------------------------------------------------------------------------------- the order


@st.composite
def graphs(draw: st.DrawFn) -> tuple[tuple[str, ...], Edges]:
    """Rooms and edges without a circle: each room imports some of those after it."""
    names = tuple("abcdefg"[: draw(st.integers(1, 7))])
    pairs = list(combinations(names, 2))
    return names, frozenset(draw(st.sets(st.sampled_from(pairs)) if pairs else st.just(set())))


def closure(edges: Edges) -> Edges:
    """All that follows from edges, by steps until nothing new follows."""
    more = edges | {(a, d) for a, b in edges for c, d in edges if b == c}
    return edges if more == edges else closure(frozenset(more))


@given(graphs())
def test_the_arrows_that_are_left_are_the_fewest_from_which_all_follow(
    graph: tuple[tuple[str, ...], Edges],
) -> None:
    names, edges = graph
    kept = reduced(names, edges)
    assert kept <= edges
    assert closure(kept) == closure(edges)
    for edge in kept:
        assert edge not in closure(kept - {edge})


@given(graphs())
def test_a_room_stands_in_the_column_after_the_last_that_it_imports(
    graph: tuple[tuple[str, ...], Edges],
) -> None:
    names, edges = graph
    level = levels(names, edges)
    for name in names:
        below = [level[used] for user, used in edges if user == name]
        assert level[name] == (1 + max(below) if below else 0)


@given(graphs())
def test_no_place_is_taken_twice_and_each_arrow_has_one_in_every_column_it_passes(
    graph: tuple[tuple[str, ...], Edges],
) -> None:
    names, edges = graph
    layer = Layer("layer", "What it answers.", names, edges)
    place = spots(layer)
    assert len(set(place.values())) == len(place)
    for user, used in reduced(names, edges):
        for column in range(place[used][0] + 1, place[user][0]):
            assert place[passing(user, used, column)][0] == column


def test_a_circle_is_refused() -> None:
    with pytest.raises(ValueError, match="cycle"):
        levels("ab", frozenset({("a", "b"), ("b", "a")}))


@every(
    ("text", "sentence"),
    [
        ("Reads a file.  Then\nit stops.", "Reads a file."),
        ("W. K. Tso, 1989 (*Part\n1*): all. `run`", "W. K. Tso, 1989 (*Part 1*): all."),
        ("At version 1.5 it ends.", "At version 1.5 it ends."),
        ("No end", ""),
    ],
)
def test_a_sentence_ends_at_its_full_stop(text: str, sentence: str) -> None:
    assert first_sentence(text) == sentence


# ------------------------------------------------------------------------------- the picture


def crossing() -> Tree:
    """A tree with an arrow that passes a room, and two columns with arrows from several rows."""
    pairs = {("e", "d"), ("d", "a"), ("e", "b"), ("d", "c"), ("f", "c"), ("f", "b")}
    layer = Layer("rooms", "Arrows pass rooms.", ("e", "d", "f", "c", "b", "a"), frozenset(pairs))
    alone = Layer("alone", "It has no room.", (), frozenset())
    return Tree((layer, alone), frozenset({("rooms", "alone")}))


@pytest.mark.slow
@pytest.mark.parametrize("which", ["package", "crossing"])
def test_the_picture_is_legible_and_nothing_overlaps(which: str, tree: Tree) -> None:
    shown = tree if which == "package" else crossing()
    figure = draw(shown)
    figure.draw_without_rendering()
    (axes,) = figure.axes
    assert figure.get_figwidth() == 7.0
    assert min(float(text.get_fontsize()) for text in axes.texts) >= 6.5
    words = {text: text.get_window_extent() for text in axes.texts}
    for one, other in combinations(words.values(), 2):
        assert not one.overlaps(other)
    for box in words.values():
        assert figure.bbox.x0 <= box.x0 < box.x1 <= figure.bbox.x1
        assert figure.bbox.y0 <= box.y0 < box.y1 <= figure.bbox.y1
    rooms = [patch.get_window_extent() for patch in axes.patches if patch.get_gid() == "room"]
    assert len(rooms) == sum(len(layer.rooms) for layer in shown.layers)
    named = [text for text in axes.texts if text.get_gid() == "room"]
    for text, frame in zip(named, rooms, strict=True):
        assert frame.x0 < words[text].x0 < words[text].x1 < frame.x1
        assert frame.y0 < words[text].y0 < words[text].y1 < frame.y1
    for one, other in combinations(rooms, 2):
        assert not one.overlaps(other)
    inner = [frame.padded(-0.5) for frame in (*rooms, *words.values())]  # half a pixel
    for line in axes.lines:
        for (x0, y0), (x1, y1) in pairwise(axes.transData.transform(line.get_xydata())):
            way = Bbox([[min(x0, x1), min(y0, y1)], [max(x0, x1), max(y0, y1)]])
            assert not any(way.overlaps(frame) for frame in inner)
