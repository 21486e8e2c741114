"""Runs the page's physics in node, with the kernels of its module."""

import json
from pathlib import Path
from typing import Any, Protocol

PARTS = Path(__file__).parents[2] / "src" / "rocksteady" / "explorer" / "parts"
SCRIPT = """
import {{ readFileSync }} from 'node:fs';
const parts = (name) => new URL(name, {parts});
const {{ load }} = await import(parts('kernels/loader.mjs'));
const kernels = await load(readFileSync({module}));
const asked = JSON.parse(readFileSync({asked}, 'utf8'));
const answer = (found) => console.log(JSON.stringify(found));
{lines}
"""


class InNode(Protocol):
    """Runs lines of a script that has `kernels`, `parts`, `asked` and `answer`."""

    def __call__(self, lines: str, asked: object = None) -> Any:
        """Return the answer."""


def script_of(module: Path, asked: Path, lines: str) -> str:
    """Return the script around some lines."""
    values = {"parts": PARTS.as_uri() + "/", "module": str(module), "asked": str(asked)}
    return SCRIPT.format(lines=lines, **{name: json.dumps(text) for name, text in values.items()})
