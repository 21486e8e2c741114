"""The basins on the page: shares as Python has them, and one initial state that is dragged."""

import math
import re

import pytest
from playwright.sync_api import Page

from rocksteady import DimensionlessBlock, Harmonic, State, compute_basins, find_attractor
from rocksteady.dynamics.basins.window import CELLS
from rocksteady.outcomes import motion_words
from rocksteady.results.numbers import chance
from tests.explorer.browser.watched import TABLED, Explorer, drawn, link, until, values

BASINS = "[data-panel='basins']"
CANVAS = f"{BASINS} canvas"
WINDOW = {"u0": -1.2, "u1": 1.2, "v0": -1.5, "v1": 1.5}
POINT = {"A": 2, "W": 6, "tab": "basins"}
CELLS_OF_ROWS = "body => [...body.rows].map(row => [...row.cells].map(cell => cell.textContent))"


def refined(page: Page) -> None:
    """Wait until every state of the window has its attractor."""
    complete = f"""() => {{
      const note = document.querySelector("{BASINS} .note").textContent;
      const words = document.querySelector("{CANVAS}").getAttribute('aria-label') ?? '';
      return !/Refining|dimmed/.test(note) && words.includes('{math.prod(CELLS)} initial states');
    }}"""
    until(page, complete, seconds=40.0)


def pixel(page: Page, x: float, y: float) -> tuple[float, float]:
    box = page.locator(CANVAS).bounding_box()
    assert box is not None
    return box["x"] + x * box["width"], box["y"] + y * box["height"]


def window_of(page: Page) -> dict[str, float]:
    found = link(page)
    return {name: float(found.get(name, default)) for name, default in WINDOW.items()}


@pytest.mark.slow
def test_shares_are_those_of_the_package(explorer: Explorer) -> None:
    page = explorer.open(POINT)
    refined(page)
    basins = compute_basins(
        DimensionlessBlock(restitution=0.8),
        Harmonic(amplitude=2.0, frequency_ratio=6.0),
    )
    page.locator(f"{BASINS} .tabled > summary").click()
    until(page, TABLED, BASINS)
    rows = page.locator(f"{BASINS} tbody").evaluate(CELLS_OF_ROWS)
    assert [row[0] for row in rows] == [attractor.name for attractor in basins.attractors]
    counts = [int(re.sub(r"\D", "", row[1])) for row in rows]
    assert counts == [part.states for part in basins.fractions()]
    (falls,) = [part.share for part in basins.fractions() if part.label == 0]
    note = page.locator(f"{BASINS} .note").inner_text()
    assert f"; {chance(falls)} of the starts on this map fall." in note
    assert page.locator("main").inner_text().count("%") == 1  # said once


@pytest.mark.slow
def test_a_state_is_dragged_and_the_other_panels_follow(explorer: Explorer) -> None:
    page = explorer.open(POINT)
    refined(page)
    page.mouse.move(*pixel(page, 0.3, 0.4))
    page.mouse.down()
    for k in range(30):
        page.mouse.move(*pixel(page, 0.3 + 0.004 * k, 0.4 + 0.003 * k))
    page.mouse.up()
    drawn(page)
    angle, velocity = (float(part) for part in link(page)["start"].split(","))
    found = find_attractor(
        DimensionlessBlock(restitution=0.8),
        Harmonic(amplitude=2.0, frequency_ratio=6.0),
        start=State(angle=angle, velocity=velocity),
    )
    assert values(page, "[data-panel='readout']")["kind"] == found.kind.value
    words = motion_words(found.kind, found.period).removeprefix("rocks")
    assert words in page.locator(f"{BASINS} .note").inner_text()


@pytest.mark.slow
def test_wheel_box_and_keys_zoom_and_0_shows_the_whole(explorer: Explorer) -> None:
    page = explorer.open(POINT)
    page.mouse.move(*pixel(page, 0.4, 0.5))
    page.mouse.wheel(0.0, -300.0)
    until(page, "() => /u0=/.test(location.hash)")
    near = window_of(page)
    assert near["u1"] - near["u0"] < 2.0
    page.keyboard.down("Shift")
    page.mouse.move(*pixel(page, 0.3, 0.4))
    page.mouse.down()
    page.mouse.move(*pixel(page, 0.5, 0.6), steps=4)
    page.mouse.up()
    page.keyboard.up("Shift")
    drawn(page)
    nearer = window_of(page)
    assert near["u0"] < nearer["u0"] < nearer["u1"] < near["u1"]
    page.locator(CANVAS).focus()
    page.keyboard.press("+")
    drawn(page)
    assert window_of(page)["u1"] - window_of(page)["u0"] < 0.6 * (nearer["u1"] - nearer["u0"])
    assert "on this map" not in page.locator(f"{BASINS} .note").inner_text()
    page.keyboard.press("0")
    drawn(page)
    assert window_of(page) == WINDOW
    page.go_back()
    drawn(page)
    assert window_of(page) != WINDOW


@pytest.mark.slow
def test_the_safe_basin_and_arrow_keys(explorer: Explorer) -> None:
    page = explorer.open(POINT)
    refined(page)
    page.get_by_text("safe basin").click()
    drawn(page)
    assert link(page)["safe"] == "1"
    page.locator(CANVAS).focus()
    page.keyboard.press("ArrowRight")
    page.keyboard.press("Shift+ArrowUp")
    drawn(page)
    angle, velocity = (float(part) for part in link(page)["start"].split(","))
    assert (angle, velocity) == (2.4 / 200, 3.0 / 20)
    sentence = str(page.locator(CANVAS).get_attribute("aria-label"))
    assert re.search(r"% of the starts on this map fall", sentence)
