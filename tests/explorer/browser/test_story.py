"""The landing and the six scenes: pushed by hand, by keys and by the address."""

import re

import pytest
from playwright.sync_api import Page

from tests.explorer.browser.test_opening import ANY_INK, panels
from tests.explorer.browser.watched import Explorer, drawn, link, until

PHONE = (390, 844)
SCENES = ("swing", "size", "fall", "fates", "order", "quake")
LANDING = "#v=1&at=push"
SAID = "([id, pattern]) => new RegExp(pattern).test(document.getElementById(id).textContent)"
WIDE = """() => [...document.querySelectorAll('#story *, #places *')].filter(one => {
  const box = one.getBoundingClientRect();
  return box.width && box.right > innerWidth + 1;
}).map(one => `${one.tagName} ${one.id || one.className}`)"""


def said(page: Page, name: str, pattern: str, seconds: float = 8.0) -> None:
    """Wait until an element says something."""
    until(page, SAID, [name, pattern], seconds=seconds)


def shake(page: Page, pixels: int) -> None:
    """Drag the ground to and fro."""
    assert page.viewport_size is not None
    x, y = page.viewport_size["width"] / 2, page.viewport_size["height"] / 2
    page.mouse.move(x, y)
    page.mouse.down()
    # More strokes than topple it: fewer do or do not, by how fast the events come.
    for there in (pixels, -pixels) * 4:
        page.mouse.move(x + there, y, steps=8)
        page.wait_for_timeout(120.0)
    page.mouse.up()


def test_the_page_opens_with_one_block_and_nothing_else(explorer: Explorer) -> None:
    page = explorer.context().new_page()
    page.goto(explorer.file.as_uri())
    drawn(page)
    assert page.get_by_role("heading", name="Push the ground.").is_visible()
    assert panels(page) == []
    until(page, f"() => ({ANY_INK})(document.getElementById('stage')) > 3")
    assert page.evaluate("location.hash") in {"", "#"}


def test_a_hand_topples_the_block_and_takes_the_push_to_the_laboratory(
    explorer: Explorer,
) -> None:
    page = explorer.open(LANDING, size=PHONE)
    shake(page, 150)
    said(page, "verdict", r"^It fell\. You moved the ground \d+ cm at \d\.\d\d g\.$")
    said(page, "facts", "impact")
    page.get_by_role("button", name="Open it in the laboratory").click()
    page.locator("[data-panel='quake']").wait_for()
    state = link(page)
    assert (state["tab"], state["b"], state["h"], state["rh"]) == ("quake", "0.3", "1", "1")
    chosen = """() => document.querySelector("[data-panel='quake'] select")
      .selectedOptions[0]?.textContent === 'your push'"""
    until(page, chosen)
    # What fell in the hand falls in the laboratory.
    until(
        page, """() => /falls/.test(document.querySelector("[data-panel='quake']").textContent)"""
    )


def test_arrow_keys_rock_the_block_and_stand_it_up(explorer: Explorer) -> None:
    page = explorer.open(LANDING)
    page.locator("#stage").focus()
    page.keyboard.press("ArrowRight")
    said(page, "verdict", "^It rocks|^It settles|^It stood")
    said(page, "verdict", r"^It stood\. You moved the ground \d+ cm", seconds=12.0)
    page.keyboard.press("r")
    said(page, "verdict", r"^Push the ground\.$")
    # A hand that does not move does not either.
    page.mouse.move(700, 400)
    page.mouse.down()
    page.wait_for_timeout(300.0)
    page.mouse.up()
    assert page.locator("#facts").inner_text() == ""


@pytest.mark.parametrize("scene", SCENES)
def test_each_scene_has_a_picture_and_one_answer(scene: str, explorer: Explorer) -> None:
    page = explorer.open({"at": scene})
    end = "this map fall" if scene == "fates" else r"\w.*"  # said when all starts are known
    said(page, f"answer-{scene}", rf"{end}\.$", seconds=20.0)
    canvas = page.locator(f"#scene-{scene} canvas")
    assert canvas.bounding_box() is not None
    until(page, f"canvas => ({ANY_INK})(canvas) > 8", canvas.element_handle())
    title, answer = (
        page.locator(f"{where}-{scene}").inner_text() for where in ("#title", "#answer")
    )
    assert canvas.get_attribute("aria-label") == f"{title} {answer}"
    assert page.locator(f"#scene-{scene}").bounding_box()["y"] < 100.0  # type: ignore[index]


def test_the_earthquake_is_answered_once_it_has_shaken(explorer: Explorer) -> None:
    page = explorer.open({"at": "quake", "pga": 0.5})
    said(page, "answer-quake", r"^All stand\. Shake the ground\.$", seconds=20.0)
    page.locator("#go-quake").focus()
    page.keyboard.press("Enter")
    said(page, "answer-quake", r"^Yours falls, but \d+ of its 26 neighbours stand\.", seconds=20.0)
    answer = page.locator("#answer-quake").inner_text()
    assert page.locator("#scene-quake canvas").get_attribute("aria-label") == (
        f"An earthquake. {answer}"
    )


@pytest.mark.slow
@pytest.mark.parametrize("scene", SCENES)
def test_a_scene_is_told_by_keys_alone_and_goes_on_in_the_laboratory(
    scene: str, explorer: Explorer
) -> None:
    page = explorer.open({"at": scene})
    end = "this map fall" if scene == "fates" else r"\w.*"  # said when all starts are known
    said(page, f"answer-{scene}", rf"{end}\.$", seconds=20.0)
    slider = page.locator(f"#scene-{scene} input[type=range]").first
    before = slider.get_attribute("aria-valuetext")
    slider.focus()
    for _ in range(5):
        page.keyboard.press("ArrowLeft")
    assert slider.get_attribute("aria-valuetext") != before
    name = str(slider.get_attribute("id")).removeprefix("slide-")
    assert float(link(page)[name]) == float(slider.input_value())
    page.locator(f"#scene-{scene} [data-lab]").focus()
    page.keyboard.press("Enter")
    page.locator(".panel:visible").first.wait_for()
    assert page.locator(".panel.failed:visible").count() == 0
    page.go_back()
    until(page, "() => !document.getElementById('story').hidden")


def test_what_an_address_says_of_the_story_is_not_trusted(explorer: Explorer) -> None:
    page = explorer.open("#v=1&at=<img src=x>&tilt=9&length=1e9&pga=nan&strength=0.9")
    assert page.locator("#notice").is_visible()
    assert page.locator("#notice img").count() == 0
    assert re.search("at.*tilt.*length.*pga", page.locator("#notice").inner_text())
    assert page.get_by_role("heading", name="Push the ground.").is_visible()


@pytest.mark.slow
def test_the_ground_nudges_itself_only_where_motion_is_welcome(explorer: Explorer) -> None:
    picture = "() => document.getElementById('stage').toDataURL()"
    still = explorer.open(LANDING)
    moving = explorer.open(LANDING, reduced_motion="no-preference")
    before, first = still.evaluate(picture), moving.evaluate(picture)
    until(moving, f"first => ({picture})() !== first", first, seconds=12.0)
    assert still.evaluate(picture) == before


@pytest.mark.slow
@pytest.mark.parametrize("width", [320, 390, 768])
def test_the_story_needs_no_scrolling_sideways(width: int, explorer: Explorer) -> None:
    page = explorer.open(LANDING, size=(width, 800))
    assert page.evaluate(WIDE) == []
    assert page.evaluate("document.documentElement.scrollWidth") <= width


@pytest.mark.slow
def test_without_kernels_the_words_of_the_story_are_left(explorer: Explorer) -> None:
    page = explorer.context().new_page()
    page.add_init_script("delete globalThis.WebAssembly;")
    page.goto(explorer.file.as_uri())
    until(page, "() => document.documentElement.dataset.ready === 'false'")
    assert page.get_by_role("heading", name="It does not swing.").is_visible()
    assert page.locator("#scene-swing canvas").is_hidden()
    explorer.watch.forgive(r"console: Error: this browser")
