"""Let it go, and Which block: dragged, switched, led to by the scenes, and equal to the package."""

import re

from playwright.sync_api import Page

from rocksteady import DimensionlessBlock, Harmonic, compute_basins
from tests.explorer.browser.test_story import said
from tests.explorer.browser.watched import Explorer, drawn, link

LAB = "#v=2&at=lab"
START = f"{LAB}&tab=start"
SIZE = f"{LAB}&tab=size&kind=push&b=0.6&h=2&pA=2.2&pW=3.6"
WIDE = (1280, 800)
SHARE = r"^From here it [a-z ]+; (\d+) % of the starts on this map fall\.$"


def sentence(page: Page) -> str:
    return page.inner_text("#bench-says")


def box_of(page: Page, name: str) -> tuple[float, float, float, float]:
    box = page.locator(f"#{name}").bounding_box()
    assert box is not None
    return float(box["x"]), float(box["y"]), float(box["width"]), float(box["height"])


def drag_point(page: Page, across: float, up: float) -> None:
    """Drag the point to shares of the picture's width and height."""
    x, y, width, height = box_of(page, "bench-picture")
    page.mouse.move(x + 0.5 * width, y + 0.5 * height)
    page.mouse.down()
    page.mouse.move(x + across * width, y + (1.0 - up) * height, steps=4)
    page.mouse.up()
    drawn(page)


def test_a_tilted_block_is_let_go_and_its_first_rock_is_timed(explorer: Explorer) -> None:
    page = explorer.open(START, size=WIDE)
    assert sentence(page) == "Tilt the block by its top, or drag the point on the curve."
    drag_point(page, 0.5, 0.5)
    said(page, "bench-says", r"^The first rock takes 0\.\d\d s\.$")
    half = float(link(page)["start"].split(",")[0])
    assert 0.3 < half < 0.6
    drag_point(page, 0.9, 0.5)
    assert float(link(page)["start"].split(",")[0]) > half
    page.get_by_role("button", name="Let it go", exact=True).click()
    page.locator("#bench-stage").press("r")
    said(page, "bench-says", r"^It has not lifted yet\.$")


def test_the_scene_of_fates_and_the_package_say_its_share(explorer: Explorer) -> None:
    page = explorer.open("#v=2&at=fates", size=WIDE)
    said(page, "answer-fates", SHARE, seconds=30.0)
    scene = page.inner_text("#answer-fates").replace("\u00a0", " ")
    page.locator("#scene-fates .onward a").click()
    said(page, "bench-says", SHARE, seconds=30.0)
    assert sentence(page) == scene
    found = re.search(SHARE, scene)
    assert found is not None
    shaking = Harmonic(amplitude=0.5, frequency_ratio=2.0)
    basins = compute_basins(DimensionlessBlock(restitution=0.8), shaking)
    share = next(
        part.share
        for part, each in zip(basins.fractions(), basins.attractors, strict=True)
        if each.kind.value == "overturned"
    )
    assert found[1] == f"{100.0 * share:.0f}"
    page.get_by_role("radio", name="still ground").click()
    said(page, "bench-says", r"^The first rock takes \d\.\d\d s\.$")


def test_the_scene_of_the_swing_says_its_first_rock(explorer: Explorer) -> None:
    page = explorer.open("#v=2&at=swing&tilt=0.7", size=WIDE)
    said(page, "answer-swing", "the first rock takes")
    found = re.search(r"first rock takes (\d\.\d\d)", page.inner_text("#answer-swing"))
    assert found is not None
    page.locator("#scene-swing .onward a").click()
    said(page, "bench-says", rf"^The first rock takes {re.escape(found[1])} s\.$")


def test_a_size_falls_and_says_how_much_wider_it_stands(explorer: Explorer) -> None:
    page = explorer.open(SIZE, size=WIDE)
    said(page, "bench-says", r"^It falls; 12 cm wider it stands\.$")
    page.fill("#bench-b", "0.72")
    page.keyboard.press("Enter")
    said(page, "bench-says", r"^It stands; \d+ cm narrower it falls\.$")
    note = page.inner_text("#bench-note")
    drag_point(page, 0.3, 0.6)
    assert {"b", "h"} <= link(page).keys()
    assert page.inner_text("#bench-note") == note, "the push stays as it is in g and Hz"
    page.get_by_role("radio", name="goes on").click()
    said(page, "bench-says", r"^It (rocks|falls|never lifts)")


def test_more_and_back_leave_the_shaking_as_it_was(explorer: Explorer) -> None:
    page = explorer.open(f"{START}&A=2.5&start=0.5,0", size=WIDE)
    page.get_by_role("link", name="More, for researchers").click()
    page.locator("[data-panel='basins']").wait_for()
    page.get_by_role("button", name="Back to the picture").click()
    page.locator("#bench").wait_for()
    assert (link(page)["A"], link(page)["tab"], link(page)["start"]) == ("2.5", "start", "0.5,0")
    said(page, "bench-says", r"^The first rock takes \d\.\d\d s\.$")


def test_no_map_and_no_share_of_another_picture_is_shown(explorer: Explorer) -> None:
    page = explorer.open(f"{START}&ground=shaken&model=linear&A=0.5&W=2&start=0.4,0", size=WIDE)
    said(page, "bench-says", SHARE, seconds=30.0)
    first = sentence(page)
    page.get_by_role("radio", name="still ground").click()
    said(page, "bench-says", "^The first rock")
    page.get_by_role("radio", name="shaken").click()
    said(page, "bench-says", SHARE, seconds=2.0)
    assert sentence(page) == first, "it was known"
    page.fill("#bench-b", "0.7")
    page.keyboard.press("Enter")
    said(page, "bench-note", "Full equations")
    said(page, "bench-says", r"^From here it [a-z ]+\.$")
