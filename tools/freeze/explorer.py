"""The explorer: what its tests ask the page's physics in node, and the pixels of its views."""

import contextlib
import io
import json
import tempfile
from collections import Counter
from collections.abc import Generator, Iterator
from pathlib import Path
from typing import Any

import pytest

from rocksteady import write_explorer
from tests.explorer.browser.watched import Explorer, Watch, chromium, values
from tools.aot.replay.outcome import MissingProgramError
from tools.freeze.records import ROOT, digest
from tools.freeze.values import of_json

ASKING = sorted(
    str(file.relative_to(ROOT))
    for file in (ROOT / "tests" / "explorer").rglob("test_*.py")
    if "in_node" in file.read_text(encoding="utf-8")
)
"""Tests that ask the page's physics."""
PIXELS = """canvas => {
  const { width, height } = canvas;
  return `${width} ${height} ${canvas.getContext('2d').getImageData(0, 0, width, height).data}`;
}"""
PAUSE = 1500.0
"""Milliseconds in which a picture may not change: it is complete then."""


class _Answers:
    """Keeps what the fixture `in_node` answers, by the names of the tests."""

    def __init__(self) -> None:
        self.items: dict[str, str] = {}
        self._asked: Counter[str] = Counter()

    @pytest.hookimpl(wrapper=True)
    def pytest_fixture_setup(self, fixturedef: Any, request: Any) -> Generator[None, Any, Any]:
        """Put a listener between a test and the fixture."""
        found = yield
        if fixturedef.argname != "in_node":
            return found

        def run(lines: str, asked: object = None) -> Any:
            answer = found(lines, asked)
            test = request.node.nodeid.removeprefix("tests/explorer/")
            self._asked[test] += 1
            self.items[f"{test} {self._asked[test]}"] = of_json(json.dumps(answer))
            return answer

        fixturedef.cached_result = (run, *fixturedef.cached_result[1:])
        return run


def freeze_physics(file: str) -> Iterator[tuple[str, str]]:
    """Yield what the tests of a file ask, and what node answers."""
    answers = _Answers()
    options = ["-q", "-p", "no:cacheprovider", "-p", "no:xdist", "-m", ""]
    options += ["-o", "filterwarnings="]
    with contextlib.chdir(ROOT), contextlib.redirect_stdout(io.StringIO()):
        pytest.main([*options, file], plugins=[answers])
    if not answers.items:
        raise MissingProgramError("node or the page's module of kernels is not there")
    yield from ((f"{file}: {name}", text) for name, text in answers.items.items())


def freeze_view(tab: str) -> Iterator[tuple[str, str]]:
    """Yield the values that a view shows, and the pixels of its canvases.

    Raises
    ------
    MissingProgramError
        If no browser is installed.
    """
    with tempfile.TemporaryDirectory() as folder, chromium() as browser:
        file = write_explorer(Path(folder, "explorer.html"))
        explorer = Explorer(browser, file, Watch())
        page = explorer.open({"tab": tab})
        for canvas in page.locator(".panel:visible .canvas canvas").all():
            canvas.scroll_into_view_if_needed()
            panel = canvas.evaluate("one => one.closest('[data-panel]').dataset.panel")
            before, now = "", digest(canvas.evaluate(PIXELS))
            while now != before:
                page.wait_for_timeout(PAUSE)
                before, now = now, digest(canvas.evaluate(PIXELS))
            yield f"{tab}: pixels of {panel}", now
        yield f"{tab}: values", "\n".join(f"{name}: {text}" for name, text in values(page).items())
        explorer.close()
