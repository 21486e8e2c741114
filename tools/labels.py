"""``python -m tools.labels``: labels, headings and long names that the sources state twice.

Printed are texts of several words, or with a unit or symbol, that stand literally in two places
where people read them: as the label of a fact, the heading of a column, the long name of a dataset,
or at the axes and in the legend of a plot.  A single word is a word of English and no statement.
"""

import argparse
import ast
import sys
from collections import defaultdict
from collections.abc import Iterator
from pathlib import Path

SOURCES = Path(__file__).parents[1] / "src" / "rocksteady"
PLACES = {
    "Column": 1,
    "Fact": 2,
    "Label": 0,
    "set_label": 0,
    "set_title": 0,
    "set_xlabel": 0,
    "set_ylabel": 0,
    "suptitle": 0,
}
"""Calls by name, and which of their arguments is a label."""
KEYS = {"heading", "label", "long_name", "title", "xlabel", "ylabel"}
"""Names of arguments and keys whose texts are labels everywhere."""
TABLES = {"AXIS", "LABELS"}
"""Constants of a module whose values are labels."""
MEANT = {"height [m]": "keys of an axis, by its name, and of a drawing, by its unit"}
"""Texts that stand in several places for a reason, and the reason."""


def labels_of(source: str) -> Iterator[tuple[str, int]]:
    """Yield each literal label of a module, and its line.

    Examples
    --------
    >>> from tools.labels import labels_of
    >>> list(labels_of('axes.set(xlabel="time [s]", ylabel=LABELS["angle"])'))
    [('time [s]', 1)]
    """
    for node in ast.walk(ast.parse(source)):
        found: list[ast.expr] = []
        if isinstance(node, ast.Call):
            name = getattr(node.func, "attr", getattr(node.func, "id", ""))
            place = PLACES.get(name, len(node.args))
            found = node.args[place : place + 1]
            found += [each.value for each in node.keywords if each.arg in KEYS]
        elif isinstance(node, ast.Dict):
            for key, value in zip(node.keys, node.values, strict=True):
                if isinstance(key, ast.Constant) and key.value in KEYS:
                    found.append(value)
        elif (
            isinstance(node, ast.Assign)
            and isinstance(node.value, ast.Dict)
            and any(getattr(target, "id", "") in TABLES for target in node.targets)
        ):
            found = node.value.values
        for each in found:
            yield from _texts(each)


def _texts(node: ast.expr) -> Iterator[tuple[str, int]]:
    """Yield the texts that an expression may be, and their lines."""
    if isinstance(node, ast.IfExp):
        yield from _texts(node.body)
        yield from _texts(node.orelse)
    elif isinstance(node, ast.Constant) and isinstance(node.value, str):
        yield node.value, node.lineno


def main(arguments: list[str]) -> int:
    """Print each text that is stated twice and where; return 1 where there is one."""
    parser = argparse.ArgumentParser(prog="python -m tools.labels", description=__doc__)
    parser.add_argument("--words", action="store_true", help="single words too")
    given = parser.parse_args(arguments)
    places: dict[str, list[str]] = defaultdict(list)
    for file in sorted(SOURCES.rglob("*.py")):
        for text, line in labels_of(file.read_text(encoding="utf-8")):
            if text and (given.words or not text.isalpha()) and text not in MEANT:
                places[text].append(f"{file.relative_to(SOURCES)}:{line}")
    twice = {text: found for text, found in places.items() if len(found) > 1}
    for text, found in sorted(twice.items(), key=lambda item: (-len(item[1]), item[0])):
        print(f"{len(found)} {text!r}: {', '.join(found)}")
    print(f"{len(twice)} labels are stated twice, in {sum(map(len, twice.values()))} places")
    return int(bool(twice))


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
