"""Joining the page's modules into one script, for the page and its workers."""

import re
from pathlib import Path

PARTS = Path(__file__).parent / "parts"
ENTRY = PARTS / "shell" / "main.mjs"

_IMPORT = re.compile(r"^import\s*\{([^}]*)\}\s*from\s*'(\.[^']+)';\n", re.MULTILINE)
_EXPORT = re.compile(r"^export ((?:async function|function|const|let|class) (\w+))", re.MULTILINE)
_COMMENT = re.compile(
    r"^[ \t]*/\*(?:(?!\*/).)*\*/[ \t]*\n|^[ \t]*//[^\n]*\n", re.MULTILINE | re.DOTALL
)


class PartError(ValueError):
    """A part of the page breaks a rule that joining depends on."""


def script(entry: Path = ENTRY) -> str:
    """Return one script of a module and all that it imports, which calls its `start`.

    Each module follows the modules it imports and has a scope of its own.  Comments are dropped.

    Raises
    ------
    PartError
        If modules import each other in a circle, or one has a form that is not understood here.
    """
    modules = joined(entry)
    numbers = {path: number for number, path in enumerate(modules)}
    texts = []
    for path, text in modules.items():

        def taken(match: re.Match[str], folder: Path = path.parent) -> str:
            names = " ".join(match[1].split()).rstrip(",")
            return f"const {{ {names} }} = $[{numbers[(folder / match[2]).resolve()]}];\n"

        given = ", ".join(name for _, name in _EXPORT.findall(text))
        code = _COMMENT.sub("", _EXPORT.sub(r"\1", _IMPORT.sub(taken, text)))
        if left := re.search(r"^(?:import|export)\b.*", code, re.MULTILINE):
            raise PartError(f"{path.name} has a form that is not joined: {left[0]}")
        if broken := [line for line in code.splitlines() if line.count("`") % 2]:
            raise PartError(f"{path.name} has a text over several lines: {broken[0].strip()}")
        texts.append(f"$.push((() => {{\n{code}return {{ {given} }};\n}})());\n")
    whole = f"'use strict';\n{{\nconst $ = [];\n{''.join(texts)}$.at(-1).start();\n}}\n"
    if "</script" in whole.lower() or "<!--" in whole:
        raise PartError("the script holds what would end it in a page")
    return re.sub(r"^[ \t]+|\n(?=\n)", "", whole, flags=re.MULTILINE)


def joined(entry: Path) -> dict[Path, str]:
    """Return the texts of a module and its imports, in the order in which they must run."""
    modules: dict[Path, str] = {}
    above: list[Path] = []

    def visit(path: Path) -> None:
        if path in above:
            circle = " -> ".join(each.name for each in (*above[above.index(path) :], path))
            raise PartError(f"modules import each other in a circle: {circle}")
        if path in modules:
            return
        above.append(path)
        text = path.read_text(encoding="utf-8")
        for _, name in _IMPORT.findall(text):
            visit((path.parent / name).resolve())
        modules[above.pop()] = text

    visit(entry.resolve())
    return modules
