"""``python -m tools.count``: code lines by package, and what has grown beyond easy reading.

A code line holds more than a comment and is no part of a docstring.  Folders of many files and long
modules are named as advice: modules are cut by concept, not by number.
"""

import argparse
import ast
import sys
from collections import Counter
from pathlib import Path

ROOT = Path(__file__).parents[1]
TOPS = ("src", "tests", "tools", "bench", "examples")
MOST = 14
"""Files of a folder, its `__init__` included."""
LONGEST = 500
"""Lines of a module."""
DOCUMENTED = ast.Module | ast.ClassDef | ast.FunctionDef | ast.AsyncFunctionDef


def code_lines(source: str) -> int:
    """Return how many code lines a module has.

    Examples
    --------
    >>> from tools.count import code_lines
    >>> code_lines("x = 1  # a number")
    1
    """
    texts: set[int] = set()
    documented: set[int] = set()
    for node in ast.walk(ast.parse(source)):
        if isinstance(node, ast.Constant | ast.JoinedStr):
            if (end := node.end_lineno or 0) > node.lineno:
                texts.update(range(node.lineno, end + 1))
        elif isinstance(node, DOCUMENTED) and ast.get_docstring(node, clean=False) is not None:
            documented.update(range(node.body[0].lineno, (node.body[0].end_lineno or 0) + 1))
    return sum(
        bool(line) and number not in documented and (number in texts or line[0] != "#")
        for number, line in enumerate(map(str.strip, source.splitlines()), 1)
    )


def main(arguments: list[str]) -> int:
    """Print the total, with `--packages` those of each, and the advice."""
    parser = argparse.ArgumentParser(prog="python -m tools.count", description=__doc__)
    parser.add_argument("--packages", action="store_true", help="the code lines of each package")
    given = parser.parse_args(arguments)
    code = {top: Counter[str]() for top in TOPS}
    files: Counter[Path] = Counter()
    for top in TOPS:
        for file in sorted((ROOT / top).rglob("*.py")):
            source = file.read_text(encoding="utf-8")
            parts = file.relative_to(
                ROOT / top / "rocksteady" if top == "src" else ROOT / top
            ).parts
            code[top][parts[0] if parts[1:] else ""] += code_lines(source)
            files[file.parent] += 1
            if (count := len(source.splitlines())) > LONGEST:
                print(f"advice: {file.relative_to(ROOT)} has {count} lines: is it one concept?")
        for part in (ROOT / top).rglob("*.mjs"):
            files[part.parent] += 1
        if given.packages:
            for package, count in code[top].most_common():
                print(f"{top}/{package:20} {count:7,}")
    for folder, count in files.items():
        if count > MOST:
            print(f"advice: {folder.relative_to(ROOT)} has {count} files: are they one concept?")
    totals = (f"{top} {sum(found.values()):,}" for top, found in code.items())
    print(f"code lines: {', '.join(totals)}")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
