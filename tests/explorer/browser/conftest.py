"""The page, written once, in one browser a worker; what it must not do fails the test."""

from collections.abc import Iterator
from pathlib import Path

import pytest
from playwright.sync_api import Browser

from rocksteady import write_explorer
from rocksteady.errors import MissingKernelsError
from tests.explorer.browser.watched import Explorer, Watch, chromium
from tests.strategies import PLAIN
from tools.aot.replay.outcome import MissingProgramError


@pytest.fixture(scope="package")
def page_file(tmp_path_factory: pytest.TempPathFactory) -> Path:
    if PLAIN:
        pytest.skip("no library is loaded")
    # A name as users have them.
    path = tmp_path_factory.mktemp("a page & its folder") / "explorer é.html"
    try:
        return write_explorer(path)
    except MissingKernelsError as error:
        pytest.skip(str(error))


@pytest.fixture(scope="package")
def browser() -> Iterator[Browser]:
    try:
        with chromium() as found:
            yield found
    except MissingProgramError as error:
        pytest.skip(str(error))


@pytest.fixture
def explorer(browser: Browser, page_file: Path) -> Iterator[Explorer]:
    watch = Watch()
    made = Explorer(browser, page_file, watch)
    yield made
    made.close()
    assert watch.faults == []
