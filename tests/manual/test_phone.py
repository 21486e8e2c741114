"""Pages of the manual on a phone: nothing sticks out, and formulae scroll in their own boxes."""

import shutil
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest
from playwright.sync_api import Page

from tests.every import every
from tests.explorer.browser.watched import chromium
from tools.aot.replay.outcome import MissingProgramError

ROOT = Path(__file__).parents[2]
LEFT_OUT = ("reference/**", "evidence/**", "tutorials/**", "guides/**", "explorer.md")
PAGES = (
    *(f"theory/{page.stem}" for page in sorted((ROOT / "docs" / "theory").glob("*.md"))),
    *("index", "glossary", "how-to/basins", "gallery/index", "gallery/histories/wall"),
)
WIDTH = 390
READY = "() => Boolean(window.MathJax?.startup?.promise)"
OUT_OF_REACH = """() => [...document.querySelectorAll("article mjx-container, article img")]
  .filter(each => {
    const right = each.getBoundingClientRect().left + Math.max(each.scrollWidth, each.offsetWidth);
    if (right <= innerWidth) return false;
    for (let box = each; box.tagName !== "ARTICLE"; box = box.parentElement)
      if (/auto|scroll/.test(getComputedStyle(box).overflowX)) return false;
    return true;
  })
  .map(each => each.outerHTML.slice(0, 200))"""
"""Formulae and pictures that end beyond the edge of the phone, in no box that scrolls."""


@pytest.fixture(scope="module", name="site")
def _site(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return the folder of a manual of some pages, with neither cells nor pictures computed."""
    folder = tmp_path_factory.mktemp("manual")
    ignored = shutil.ignore_patterns("gallery", "*.gif")
    shutil.copytree(ROOT / "docs", folder / "docs", ignore=ignored)
    for name in ("examples", "tools"):
        (folder / name).symlink_to(ROOT / name)
    overrides = {
        "nb_execution_mode": "off",
        "plot_gallery": "0",
        "nitpicky": "0",
        "exclude_patterns": ",".join((*LEFT_OUT, "gallery/**/*.py", "gallery/**/*.ipynb")),
    }
    words = [word for name, value in overrides.items() for word in ("-D", f"{name}={value}")]
    command = [sys.executable, "-m", "sphinx", "--quiet", "--jobs", "1", *words, "docs", "out"]
    subprocess.run(command, cwd=folder, check=True, capture_output=True)
    return folder / "out"


@pytest.fixture(name="phone")
def _phone() -> Iterator[Page]:
    """Return a page of a browser, as wide as a phone."""
    try:
        with chromium() as browser:
            yield browser.new_page(viewport={"width": WIDTH, "height": 844})
    except MissingProgramError as error:
        pytest.skip(str(error))


@pytest.mark.slow
@every("name", PAGES)
def test_no_page_is_wider_than_a_phone(name: str, phone: Page, site: Path) -> None:
    phone.goto((site / f"{name}.html").as_uri())
    if phone.locator("article .math").count():
        phone.wait_for_function(READY)
        phone.evaluate("() => MathJax.startup.promise")
    for box in ("html", ".content"):
        assert phone.locator(box).evaluate("box => box.scrollWidth") <= WIDTH
    assert phone.evaluate(OUT_OF_REACH) == []
