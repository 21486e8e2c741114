"""A page in the browser, and what it does that it must not."""

import re
import shutil
import time
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from urllib.parse import quote

from playwright.sync_api import (
    Browser,
    BrowserContext,
    ConsoleMessage,
    Dialog,
    Page,
    Request,
    WebError,
    sync_playwright,
)

from tools.aot.replay.outcome import MissingProgramError

PROGRAMS = ("chromium", "chromium-browser", "google-chrome")
FLAGS = ["--no-sandbox", "--disable-gpu", "--force-color-profile=srgb"]
WIDE = (1440, 900)
DIMENSIONLESS = "#v=1&at=lab&units=none"
"""Fragment of the laboratory with amplitudes and ratios."""
OWN = re.compile(r"(?:file|blob|data|about):")
"""Addresses that a page from a file may load."""
TABLED = "panel => document.querySelector(`${panel} tbody tr`)"
"""The table of a panel has rows: it is filled after it is opened."""
READY = "() => document.documentElement.dataset.ready"
FRAMES = """count => new Promise(done => {
  const next = () => count-- > 0 ? requestAnimationFrame(next) : done(true);
  next();
})"""


@contextmanager
def chromium() -> Iterator[Browser]:
    """Start Chromium, the system's or Playwright's own.

    Raises
    ------
    MissingProgramError
        If there is neither.
    """
    with sync_playwright() as playwright:
        kind = playwright.chromium
        program = next(filter(None, map(shutil.which, PROGRAMS)), kind.executable_path)
        if not Path(program).exists():
            raise MissingProgramError(
                "no Chromium: .venv/bin/playwright install chromium, or apt install chromium"
            )
        browser = kind.launch(executable_path=program, args=FLAGS)
        yield browser
        browser.close()


@dataclass
class Watch:
    """What pages of a test did that none may do."""

    faults: list[str] = field(default_factory=list)

    def attach(self, context: BrowserContext) -> None:
        """Note all that the pages of a context, their frames and workers do."""
        context.on("console", self._console)
        context.on("weberror", self._error)
        context.on("dialog", self._dialog)
        context.on("request", self._request)
        # Nothing leaves the machine, even where a test fails.
        context.route(lambda address: not OWN.match(address), lambda route: route.abort())

    def forgive(self, pattern: str) -> None:
        """Take out faults that a test asks for; there must be one."""
        kept = [fault for fault in self.faults if not re.search(pattern, fault)]
        assert len(kept) < len(self.faults), (pattern, self.faults)
        self.faults = kept

    def _console(self, message: ConsoleMessage) -> None:
        if message.type == "error" or message.text.startswith("no worker"):
            self.faults.append(f"console: {message.text}")

    def _error(self, error: WebError) -> None:
        self.faults.append(f"error: {error.error}")

    def _dialog(self, dialog: Dialog) -> None:
        self.faults.append(f"dialog: {dialog.message}")
        dialog.dismiss()

    def _request(self, request: Request) -> None:
        if not OWN.match(request.url):
            self.faults.append(f"request: {request.url}")


@dataclass
class Explorer:
    """Opens the page in contexts of their own, which all are watched.

    Attributes
    ----------
    browser
        The browser.
    file
        The page.
    watch
        What was done.
    contexts
        All that were opened.
    """

    browser: Browser
    file: Path
    watch: Watch
    contexts: list[BrowserContext] = field(default_factory=list)

    def context(self, size: tuple[int, int] = WIDE, **how: object) -> BrowserContext:
        """Return a new context, in which motion is reduced unless it is said otherwise."""
        settings = {"reduced_motion": "reduce", "accept_downloads": True} | how
        made = self.browser.new_context(
            viewport={"width": size[0], "height": size[1]},
            **settings,  # type: ignore[arg-type]
        )
        made.set_default_timeout(8000.0)
        self.watch.attach(made)
        self.contexts.append(made)
        return made

    def open(
        self,
        state: Mapping[str, object] | str = "",
        size: tuple[int, int] = WIDE,
        **how: object,
    ) -> Page:
        """Return the page at a state, or at a fragment, once it is drawn."""
        page = self.context(size, **how).new_page()
        page.goto(self.file.as_uri() + fragment(state))
        drawn(page)
        return page

    def close(self) -> None:
        """Close all contexts."""
        for context in self.contexts:
            context.close()


def fragment(state: Mapping[str, object] | str) -> str:
    """Return the fragment of a state; the laboratory's where nothing is given."""
    if isinstance(state, str):
        return state or "#v=1&at=lab"
    return "#v=1" + "".join(f"&{name}={quote(str(value))}" for name, value in state.items())


def drawn(page: Page, frames: int = 2) -> None:
    """Wait until the page runs and has drawn what it computes at once."""
    until(page, f"() => ({READY})() === 'true'")
    page.evaluate(FRAMES, frames)


def until(page: Page, script: str, asked: object = None, seconds: float = 8.0) -> None:
    """Wait until a function of the page returns a true value.

    The page's policy forbids Playwright's own waiting, which evaluates a text in the page.
    """
    end = time.monotonic() + seconds
    while not (found := page.evaluate(script, asked)):
        assert time.monotonic() < end, (script, found)
        page.wait_for_timeout(20.0)


def turn_to(page: Page, state: Mapping[str, object] | str) -> None:
    """Put a state into the page's address, as following a link does."""
    page.evaluate("fragment => { location.hash = fragment; }", fragment(state))
    page.evaluate(FRAMES, 2)


def link(page: Page) -> dict[str, str]:
    """Return the state in the page's address."""
    text = page.evaluate("decodeURIComponent(location.hash.slice(1))")
    return dict(part.split("=", 1) for part in text.split("&") if part)


def values(page: Page, inside: str = "body") -> dict[str, str]:
    """Return the values that the page shows, by their names, in full.

    Those of a motion that has to be followed for long come from a worker.
    """
    until(page, "() => document.querySelector('[data-whole=\"false\"]') === null", seconds=30.0)
    script = """root => Object.fromEntries([...document.querySelectorAll(
      `${root} [data-name][data-value]`)].map(one => [one.dataset.name, one.dataset.value]))"""
    found: dict[str, str] = page.evaluate(script, inside)
    return found
