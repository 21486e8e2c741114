"""What presenters print and what becomes of their values as JSON."""

import contextlib
import io
import json
from collections.abc import Callable
from typing import Any

from rocksteady.cli.console.outputs import print_json

WIDTH = 80


def printed(present: Callable[..., None], *given: Any, **more: Any) -> str:
    """Return what a presenter prints."""
    out = io.StringIO()
    with contextlib.redirect_stdout(out):
        present(*given, **more)
    return out.getvalue()


def fits(text: str) -> bool:
    """Return whether a text fits into 80 columns with no cell cut off."""
    return all(len(line.rstrip()) <= WIDTH for line in text.splitlines()) and "…" not in text


def as_json(values: dict[str, Any]) -> dict[str, Any]:
    """Return values as `--json` prints them; a number that JSON does not have is an error."""
    out = io.StringIO()
    with contextlib.redirect_stdout(out):
        print_json("anything", values)
    found = json.loads(out.getvalue(), parse_constant=_refused)
    assert isinstance(found, dict)
    assert found.pop("schema") == "rocksteady/anything/1"
    return found


def _refused(constant: str) -> None:
    message = f"{constant} is no JSON"
    raise AssertionError(message)
