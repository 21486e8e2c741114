"""``python -m tools.count``: code lines by package, and what has grown beyond easy reading.

A code line holds more than a comment and is no part of a docstring.  Folders of many files and long
modules are named as advice: modules are cut by concept, not by number.
"""

import ast
import re
import sys
from collections import Counter
from pathlib import Path

ROOT = Path(__file__).parents[1]
TOPS = ("src", "tests", "tools", "bench", "examples")
MOST = 14
"""Files of a folder, its `__init__` included."""
LONGEST = 500
"""Lines of a module."""
COMMENT = re.compile(r"/\*.*?\*/", re.DOTALL)
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


def script_lines(source: str) -> int:
    """Return how many code lines a module of JavaScript has: neither blank nor comment alone."""
    text = COMMENT.sub("", source)
    return sum(
        bool(line) and not line.startswith("//") for line in map(str.strip, text.split("\n"))
    )


def main() -> int:
    """Print the code lines of each package, of each top folder and of JavaScript, and advice."""
    code = {top: Counter[str]() for top in TOPS}
    scripts = 0
    files: Counter[Path] = Counter()
    advice = []
    for top in TOPS:
        inside = ROOT / top / "rocksteady" if top == "src" else ROOT / top
        for file in sorted(inside.rglob("*.py")):
            source = file.read_text(encoding="utf-8")
            parts = file.relative_to(inside).parts
            code[top][parts[0] if parts[1:] else ""] += code_lines(source)
            files[file.parent] += 1
            if (count := len(source.splitlines())) > LONGEST:
                advice.append(f"{file.relative_to(ROOT)} has {count} lines: is it one concept?")
        for part in inside.rglob("*.mjs"):
            files[part.parent] += 1
            scripts += script_lines(part.read_text(encoding="utf-8"))
    for folder, count in files.items():
        if count > MOST:
            advice.append(f"{folder.relative_to(ROOT)} has {count} files: are they one concept?")
    for top, found in code.items():
        for package, count in found.most_common():
            print(f"{f'{top}/{package}':24} {count:8,}")
    for top, found in code.items():
        print(f"{top:24} {sum(found.values()):8,}")
    print(f"{'JavaScript':24} {scripts:8,}")
    for line in advice:
        print(f"advice: {line}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
