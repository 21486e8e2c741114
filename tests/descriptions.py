"""What tests of descriptions check: widths of texts, and JSON as a command prints it."""

import json
from typing import Any

from rocksteady.show.export.files import json_text

WIDTH = 80


def fits(text: str) -> bool:
    """Return whether a text fits into 80 columns with no cell cut off."""
    return all(len(line.rstrip()) <= WIDTH for line in text.splitlines()) and "…" not in text


def as_json(values: dict[str, Any]) -> dict[str, Any]:
    """Return values as `--json` prints them; a number that JSON does not have is an error."""
    found = json.loads(json_text("anything", values), parse_constant=_refused)
    assert isinstance(found, dict)
    assert found.pop("schema") == "anything"
    return found


def _refused(constant: str) -> None:
    message = f"{constant} is no JSON"
    raise AssertionError(message)
