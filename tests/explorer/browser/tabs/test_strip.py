"""The bifurcation strip: what its sweeps meet, and the point that is dragged along it."""

import re
import time

import numpy as np
import pytest
from playwright.sync_api import FloatRect, Page

from rocksteady import Block, DimensionlessBlock, Harmonic, Rest, Steady
from rocksteady.model.units import in_units
from rocksteady.orbits import sweep_attractor
from tests.explorer.browser.watched import TABLED, Explorer, drawn, link, until, values

STRIP = "[data-panel='strip']"
CANVAS = f"{STRIP} canvas"
ROWS = 200
"""Of a table on the page: of its 402 rows the first."""


def swept(page: Page, way: str = "") -> str:
    """Return what the strip says once both sweeps are complete."""
    end = time.monotonic() + 30.0
    note = page.locator(f"{STRIP} .note")
    while re.search("Sweep", found := note.inner_text()) or way not in found or not found:
        assert time.monotonic() < end, found
        page.wait_for_timeout(50.0)
    return found


def box_of(page: Page) -> FloatRect:
    canvas = page.locator(CANVAS)
    canvas.scroll_into_view_if_needed()
    box = canvas.bounding_box()
    assert box is not None
    return box


def peaks_of(page: Page) -> tuple[str, float]:
    """Return kind and highest angle of the motion at the point."""
    shown = values(page, "[data-panel='readout']")
    return shown["kind"], float(shown["highest"])


@pytest.mark.slow
def test_that_the_start_decides_is_seen_at_a_glance(explorer: Explorer) -> None:
    page = explorer.open({"A": 0.8, "W": 2})
    assert "How it begins decides at" in swept(page)
    page.locator(f"{STRIP} .tabled > summary").click()
    until(page, TABLED, STRIP)
    rows = page.locator(f"{STRIP} tbody tr").all_inner_texts()
    cells = [row.split("\t") for row in rows]
    sweep = sweep_attractor(
        DimensionlessBlock(restitution=0.8),
        Harmonic(amplitude=0.8, frequency_ratio=2.0),
        "frequency_ratio",
        np.linspace(0.5, 8.0, 201),
        start=Rest(),
    )
    assert [row[3] for row in cells] == sweep.kinds[:ROWS]
    assert {row[2] for row in cells} == {"up"}
    block = Block.rectangle(width=0.5, height=2.0, restitution=0.8)
    ratios = [float(row[1]) for row in cells]
    hertz = in_units({"frequency_ratio": ratios}, block)["freq_hz"]
    assert [float(row[0]) for row in cells] == pytest.approx(hertz, rel=1e-5)


@pytest.mark.slow
def test_a_click_on_a_dot_goes_to_its_motion(explorer: Explorer) -> None:
    """The dots of the sweep downwards are found as a reader finds them: one above the other."""
    page = explorer.open({"A": 0.8, "W": 2, "by": "a"})
    swept(page)
    page.locator(CANVAS).focus()
    assert peaks_of(page) == ("rest", 0.0)
    page.keyboard.press("Enter")
    drawn(page)
    met = {peaks_of(page)[0]}
    page.keyboard.press("Enter")
    drawn(page)
    met.add(peaks_of(page)[0])
    assert met == {"rest", "symmetric"}
    down = sweep_attractor(
        DimensionlessBlock(restitution=0.8),
        Harmonic(amplitude=0.8, frequency_ratio=2.0),
        "amplitude",
        np.linspace(0.0, 6.0, 201)[::-1],
        start=Steady(),
    )
    found = link(page)
    place = int(np.argmin(np.abs(down.values - 0.8)))
    orbit = down.attractors[place].orbit
    assert orbit is not None
    if ":" in found.get("start", ""):
        first = orbit.states[0]
        numbers = [float(part) for part in found["start"].split(":")]
        assert numbers == [first.side, first.phase, first.speed]
    else:
        assert found.get("start", "rest") == "rest"


@pytest.mark.slow
def test_the_point_is_dragged_along_the_strip_and_stays_in_its_row(explorer: Explorer) -> None:
    page = explorer.open({"A": 2, "W": 3})
    swept(page)
    box = box_of(page)
    y = box["y"] + 0.5 * box["height"]
    page.mouse.move(box["x"] + 0.4 * box["width"], y)
    page.mouse.down()
    for k in range(20):
        page.mouse.move(box["x"] + (0.4 + 0.02 * k) * box["width"], y)
    page.mouse.up()
    drawn(page)
    shown = link(page)
    assert 5.0 < float(shown["W"]) < 8.0
    assert shown.get("A", "2") == "2"
    assert "dimmed" not in page.locator(f"{STRIP} .note").inner_text()


@pytest.mark.slow
def test_the_stable_subharmonic_is_one_click_away(explorer: Explorer) -> None:
    page = explorer.open({"A": 2, "W": 6})
    assert "it rocks, alike every third shake" in swept(page)
    box = box_of(page)
    x = box["x"] + 0.7 * box["width"]
    for share in np.arange(0.85, 0.2, -0.02):
        page.mouse.click(x, box["y"] + float(share) * box["height"])
        drawn(page)
        if "start" in link(page) and values(page, "[data-panel='readout']")["period"] == "3":
            return
        page.wait_for_timeout(30.0)
    raise AssertionError("no click has met the line")


@pytest.mark.slow
def test_arrows_move_the_point_and_the_other_parameter_has_its_strip(explorer: Explorer) -> None:
    page = explorer.open({"A": 2, "W": 3})
    swept(page)
    page.locator(CANVAS).focus()
    page.keyboard.press("ArrowRight")
    drawn(page)
    assert float(link(page)["W"]) > 3.0
    page.get_by_role("button", name="over A").click()
    until(page, "() => /^#.*by=a/.test(location.hash)")
    swept(page)
    page.locator(CANVAS).focus()
    page.keyboard.press("Shift+ArrowLeft")
    drawn(page)
    assert float(link(page)["A"]) < 1.8
