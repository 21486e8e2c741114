"""The laboratory's first question: pushed by hand, dragged, typed, asked and printed."""

import re

import pytest
from playwright.sync_api import Page

from tests.explorer.browser.test_story import said
from tests.explorer.browser.watched import Explorer, drawn, link, until

LAB = "#v=2&at=lab"
PUSH = f"{LAB}&kind=push&b=0.25&h=1&pA=2.8&pW=3.6"
WIDE = (1280, 800)
PHONE = (390, 844)
INVITED = "Push the ground, or drag the point on the map."
SIDEWAYS = "document.documentElement.scrollWidth - innerWidth"
MAPPED = """() => {
  const pen = document.getElementById('bench-picture').getContext('2d');
  const { width, height } = pen.canvas, colours = new Set();
  for (let k = 1; k < 20; k++) {
    const row = Math.round(0.12 * height + 0.7 * height * k / 20);
    colours.add(pen.getImageData(Math.round(width * 0.95), row, 1, 1).data.join());
  }
  return colours.size > 1;
}"""


def sentence(page: Page) -> str:
    return page.inner_text("#bench-says")


def box_of(page: Page, name: str) -> dict[str, float]:
    box = page.locator(f"#{name}").bounding_box()
    assert box is not None
    return {key: float(value) for key, value in box.items()}  # type: ignore[arg-type]


def hand(page: Page) -> tuple[float, float]:
    """Return where the hand is under the block, which stands in the left two fifths."""
    box = box_of(page, "bench-stage")
    left = page.evaluate("document.getElementById('bench-right').offsetLeft")
    return box["x"] + 0.5 * (left - 16.0), box["y"] + box["height"] - 44.0


def test_it_opens_with_the_act_and_a_map_and_answers_a_link(explorer: Explorer) -> None:
    page = explorer.open(LAB, size=WIDE)
    assert sentence(page) == INVITED
    until(page, MAPPED)
    assert page.get_by_role("tab", name="Shake it").get_attribute("aria-selected") == "true"
    linked = explorer.open(PUSH, size=WIDE)
    said(linked, "bench-says", r"^It falls after an impact; at 0\.44 g it would stand\.$")


def test_a_push_moves_the_ground_and_leaves_its_dot(explorer: Explorer) -> None:
    page = explorer.open(f"{LAB}&b=1&h=1.3", size=WIDE)
    x, y = hand(page)
    page.mouse.move(x, y)
    page.mouse.down()
    for there in (90, -90) * 2:
        page.mouse.move(x + there, y, steps=6)
        page.wait_for_timeout(60.0)
    page.mouse.up()
    said(page, "bench-says", r"^It (stood|fell|did not lift|settles|rocks)")
    said(page, "bench-facts", "the dot on the map is your push")


def test_the_point_is_dragged_and_the_film_ends_as_the_sentence_says(explorer: Explorer) -> None:
    page = explorer.open(f"{LAB}&kind=push", size=WIDE)
    box = box_of(page, "bench-picture")
    page.mouse.move(box["x"] + 300.0, box["y"] + 200.0)
    page.mouse.down()
    page.mouse.move(box["x"] + 200.0, box["y"] + 80.0, steps=4)
    page.mouse.up()
    said(page, "bench-says", r"^It falls at once; at \d\.\d\d g it would stand\.$")
    assert len(re.findall(r"\d+\.\d+", sentence(page))) == 1
    assert {"pA", "pW"} <= link(page).keys()


def test_sizes_are_dragged_and_typed_and_refused_with_what_is_valid(explorer: Explorer) -> None:
    page = explorer.open(PUSH, size=WIDE)
    _, y = hand(page)
    field = page.locator("#bench-b")
    box = box_of(page, "bench-stage")
    room = page.evaluate(
        "document.getElementById('bench-b').parentElement.getBoundingClientRect().x"
    )
    page.mouse.move(room - 12.0, box["y"] + box["height"] - 112.0 + 26.0)
    page.mouse.down()
    page.mouse.move(room + 12.0, y, steps=4)
    page.mouse.up()
    until(page, "() => location.hash.includes('b=')")
    drawn(page)
    width = float(field.input_value())
    assert 0.26 < width < 0.5
    assert float(link(page)["b"]) == width
    page.fill("#bench-h", "1,5")
    page.keyboard.press("Enter")
    until(page, "() => location.hash.includes('h=1.5')")
    page.fill("#bench-h", "99")
    page.keyboard.press("Enter")
    said(page, "bench-facts", r"^Height: \d\.\d\d to 8\.00 m\.$")
    assert page.input_value("#bench-h") == "1.5"


def test_the_block_is_tilted_by_its_top_and_let_go(explorer: Explorer) -> None:
    page = explorer.open(PUSH, size=WIDE)
    x, y = hand(page)
    field = page.locator("#bench-h").bounding_box()
    assert field is not None
    foot = y - 68.0
    middle = field["y"] + 0.5 * field["height"]
    top = foot - 2.0 * (foot - middle)
    page.mouse.move(x, top)
    page.mouse.down()
    page.mouse.move(x + 40.0, top, steps=4)
    said(page, "bench-says", r"^Let it go\.$")
    page.mouse.up()
    said(page, "bench-says", r"^It (rocks|settles|stood)\.$")
    said(page, "bench-facts", r"^it leaned \d+\.\d°; past 14\.0° it tips$", seconds=15.0)


def test_the_switch_changes_the_words_and_keys_reach_everything(explorer: Explorer) -> None:
    page = explorer.open(f"{LAB}&A=2.5", size=WIDE)
    said(page, "bench-says", r"^It rocks with the shaking, and leans \d+\.\d° at most\.$")
    page.locator("[data-value='on']").focus()
    page.keyboard.press("ArrowRight")
    drawn(page)
    assert link(page)["kind"] == "push"
    assert page.inner_text("#bench-act") == "Push it"
    page.locator("#bench-picture").focus()
    before = float(link(page).get("pA", "2.5"))
    page.keyboard.press("Shift+ArrowUp")
    drawn(page)
    assert float(link(page)["pA"]) > before
    page.locator("#bench-stage").focus()
    page.keyboard.down("ArrowRight")
    page.wait_for_timeout(200.0)
    page.keyboard.up("ArrowRight")
    page.keyboard.press("r")
    said(page, "bench-says", "has not lifted yet|did not lift|It stood|rocks|fell|Past")


def test_more_opens_the_researchers_room_and_back_returns(explorer: Explorer) -> None:
    page = explorer.open(PUSH, size=WIDE)
    more = page.get_by_role("link", name="More, for researchers")
    assert "b=0.25" in str(more.get_attribute("href"))
    more.click()
    page.locator("[data-panel='pulse']").wait_for()
    assert link(page)["tab"] == "pulse"
    assert not page.locator("#bench").is_visible()
    page.get_by_role("button", name="Back to the picture").click()
    page.locator("#bench").wait_for()
    said(page, "bench-says", r"^It falls after an impact")


def test_nothing_scrolls_sideways(explorer: Explorer) -> None:
    page = explorer.open(LAB, size=WIDE)
    for width in (320, 390, 768, 1024, 1280, 1600, 2560):
        page.set_viewport_size({"width": width, "height": 844})
        drawn(page)
        assert page.evaluate(SIDEWAYS) <= 0, width


@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_a_shaking_that_goes_on_is_shown_without_an_error(scheme: str, explorer: Explorer) -> None:
    page = explorer.open(
        f"{LAB}&A=2.5", size=PHONE, color_scheme=scheme, reduced_motion="no-preference"
    )
    page.get_by_role("button", name="Shake it", exact=True).click()
    said(page, "bench-says", "^It rocks")
    page.wait_for_timeout(600.0)
    moving = "document.getElementById('bench-stage').toDataURL().length"
    first = page.evaluate(moving)
    page.wait_for_timeout(150.0)
    assert page.evaluate(moving) != first
