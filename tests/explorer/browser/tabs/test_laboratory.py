"""The laboratory's promises: addresses, fields, names, stillness and the printed sheet."""

import io
import re

import numpy as np
import pytest
from numpy.typing import NDArray
from PIL import Image
from playwright.sync_api import Page

from tests.every import every
from tests.explorer.browser.tabs.test_shake import LAB, MAPPED, PHONE, PUSH, WIDE, sentence
from tests.explorer.browser.test_story import said
from tests.explorer.browser.watched import Explorer, drawn, link, until

FALLS = f"{LAB}&kind=push&b=0.4&pA=4&pW=2"
SHEET = (1047, 718)
"""A4 landscape within its margins [px]."""
STAGE = "document.getElementById('bench-stage').toDataURL()"
DARK_COLUMNS = """() => {
  const canvas = document.getElementById('bench-stage'), { width, height } = canvas;
  const ratio = width / canvas.clientWidth, row = Math.round(height - (112 + 20) * ratio);
  const { data } = canvas.getContext('2d').getImageData(0, row, width, 1);
  const dark = Array.from({ length: width }, (_, k) => k).filter(
    k => data[4 * k + 3] > 200 && data[4 * k] + data[4 * k + 1] + data[4 * k + 2] < 200);
  return [dark[0] / ratio, dark.at(-1) / ratio];
}"""


def ink(page: Page) -> NDArray[np.bool_]:
    """Return where the picture of a page is not white."""
    shot = Image.open(io.BytesIO(page.screenshot())).convert("RGB")
    return np.asarray((255 - np.asarray(shot, dtype=int)).max(axis=2) > 8)


@every(
    ("address", "ignored", "height"),
    [
        (f"{LAB}&A=1e999&b=NaN&h=1.5&evil=<img src=x>&__proto__=1", "evil, __proto__, A, b", "1.5"),
        (f"{LAB}&tab=../../etc&kind=<script>&h=1.25", "tab, kind", "1.25"),
        (f"{LAB}&A=%E0%A4%A&pA=0x10&pW=&h=3", "A, pA, pW", "3"),
    ],
)
def test_what_is_wrong_in_an_address_has_one_notice_and_the_rest_is_read(
    address: str, ignored: str, height: str, explorer: Explorer
) -> None:
    page = explorer.open(address, size=WIDE)
    said(page, "notice", rf"^Ignored, [^:]+: {ignored}\.$")
    assert page.locator("#notice *").count() == 0
    assert page.input_value("#bench-h") == height
    said(page, "bench-says", "^It ")


def test_an_unknown_place_is_the_landing_and_an_old_link_is_read(explorer: Explorer) -> None:
    page = explorer.open("#v=2&at=nowhere", size=WIDE)
    assert page.get_by_role("heading", name="Push the ground.").is_visible()
    said(page, "notice", r": at\.$")
    old = explorer.open("#v=1&tab=pulse&pA=2.8&pW=3.6&b=0.25&h=1", size=WIDE)
    assert old.locator("#notice").is_hidden()
    read = {"tab": "pulse", "pA": "2.8", "b": "0.25", "h": "1"}
    assert read.items() <= link(old).items()
    old.get_by_role("button", name="Back to the picture").click()
    assert old.input_value("#bench-b") == "0.25"


@pytest.mark.parametrize("place", [LAB, "#v=2&at=swing"])
def test_without_webassembly_a_sentence_and_the_picture_are_seen(
    place: str, explorer: Explorer
) -> None:
    page = explorer.context(WIDE).new_page()
    page.add_init_script("delete globalThis.WebAssembly;")
    page.goto(explorer.file.as_uri() + place)
    until(page, "() => document.documentElement.dataset.ready === 'false'")
    assert "no WebAssembly" in page.inner_text("#refusal")
    picture = page.locator("#still svg").bounding_box()
    assert picture is not None
    assert picture["y"] + picture["height"] < WIDE[1]
    assert page.locator("canvas:visible").count() == 0
    explorer.watch.forgive(r"console: Error: this browser")


def test_a_field_takes_a_comma_and_says_what_is_valid(explorer: Explorer) -> None:
    page = explorer.open(PUSH, size=WIDE)
    page.fill("#bench-b", "0,4")
    page.keyboard.press("Enter")
    until(page, "() => location.hash.includes('b=0.4&')")
    assert page.input_value("#bench-b") == "0.4"
    said(page, "bench-facts", r"^it tips past 21\.8°$")
    kept = page.evaluate("location.hash")
    for name, refused, valid in (
        ("b", "", r"Width: 0\.05 to 0\.90 m\."),
        ("b", "abc", r"Width: 0\.05 to 0\.90 m\."),
        ("b", "0.91", r"Width: 0\.05 to 0\.90 m\."),
        ("h", "-1", r"Height: 0\.44 to 8\.00 m\."),
        ("h", "8.1", r"Height: 0\.44 to 8\.00 m\."),
    ):
        page.fill(f"#bench-{name}", refused)
        page.keyboard.press("Enter")
        said(page, "bench-facts", f"^{valid}$")
        assert page.input_value(f"#bench-{name}") == {"b": "0.4", "h": "1"}[name]
    assert page.evaluate("location.hash") == kept


def test_both_canvases_have_names_and_the_sentence_is_spoken(explorer: Explorer) -> None:
    page = explorer.open(PUSH, size=WIDE)
    said(page, "bench-says", r"^It falls after an impact; at \d\.\d\d g it would stand\.$")
    spoken = page.get_by_role("status").filter(has_text=sentence(page))
    assert spoken.get_attribute("aria-live") == "polite"
    block = page.get_by_role("application", name=re.compile(r"^Your block, 0\.25 by 1\.00 metres"))
    assert sentence(page) in str(block.get_attribute("aria-label"))
    named = re.compile(r"^How hard may the ground shake\? 0\.\d\d g, \d\.\d\d Hz\. The arrow keys")
    assert page.get_by_role("application", name=named).is_visible()
    for name in ("Width in metres", "Height in metres"):
        assert page.get_by_role("textbox", name=name).is_visible()
    shown = page.get_by_role("tabpanel", name="Shake it").get_attribute("id")
    assert page.get_by_role("tab", selected=True).get_attribute("aria-controls") == shown


def test_with_reduced_motion_it_lies_at_once_in_the_middle_of_its_column(
    explorer: Explorer,
) -> None:
    page = explorer.open(FALLS, size=WIDE)
    said(page, "bench-says", "^It falls at once")
    standing = page.evaluate(STAGE)
    page.get_by_role("button", name="Push it").click()
    until(page, f"before => {STAGE} !== before", standing)
    drawn(page, 12)
    before = page.evaluate(STAGE)
    page.wait_for_timeout(300.0)
    assert page.evaluate(STAGE) == before
    lies_in_the_middle(page)


def test_a_film_brings_what_fell_to_the_middle_of_its_column(explorer: Explorer) -> None:
    page = explorer.open(FALLS, size=WIDE, reduced_motion="no-preference")
    said(page, "bench-says", "^It falls at once")
    page.get_by_role("button", name="Push it").click()
    page.wait_for_timeout(5000.0)
    lies_in_the_middle(page)


def lies_in_the_middle(page: Page) -> None:
    """Check that the block lies in the middle of its column, two metres long."""
    left, right = page.evaluate(DARK_COLUMNS)
    column = page.evaluate("document.getElementById('bench-right').offsetLeft") - 16.0
    assert abs(0.5 * (left + right) - 0.5 * column) < 12.0
    assert right - left > 0.5 * column


def test_a_block_keeps_its_scale_in_a_window_that_changes(explorer: Explorer) -> None:
    page = explorer.open(PUSH, size=(1280, 1100), reduced_motion="no-preference")
    said(page, "bench-says", "^It falls")
    page.set_viewport_size({"width": WIDE[0], "height": WIDE[1]})
    drawn(page, 4)
    changed = page.evaluate(STAGE)
    fresh = explorer.open(PUSH, size=WIDE, reduced_motion="no-preference")
    said(fresh, "bench-says", "^It falls")
    until(fresh, f"changed => {STAGE} === changed", changed)


@every(("size", "scheme"), [(WIDE, "dark"), (PHONE, "light")])
def test_it_prints_as_one_light_sheet_with_its_block_and_map(
    size: tuple[int, int], scheme: str, explorer: Explorer
) -> None:
    page = explorer.open(PUSH, size=size, color_scheme=scheme)
    until(page, MAPPED)
    screen = page.evaluate(STAGE)
    printed = page.pdf(prefer_css_page_size=True)
    assert len(re.findall(rb"/Type\s*/Page\b", printed)) == 1
    box = re.search(rb"/MediaBox\s*\[\s*0 0 ([\d.]+) ([\d.]+)", printed)
    assert box is not None
    assert float(box[1]) > 1.4 * float(box[2])
    until(page, f"screen => {STAGE} === screen", screen)
    # The sheet as the printer sees it.
    page.evaluate("dispatchEvent(new Event('beforeprint'))")
    page.emulate_media(media="print", color_scheme="dark" if scheme == "dark" else "light")
    page.set_viewport_size({"width": SHEET[0], "height": SHEET[1]})
    inked = ink(page)
    column = page.evaluate("document.getElementById('bench-right').offsetLeft")
    level = page.locator("#bench-picture").bounding_box()
    assert level is not None
    top, foot = int(level["y"]), int(level["y"] + level["height"])
    assert inked[top:foot, column:].mean() > 0.3
    assert inked[top:foot, :column].mean() > 0.02
    assert inked[:, : SHEET[0]].mean() < 0.7, "it is dark"
    assert page.locator("#tabs").is_hidden()
    assert page.locator("#bench-act").is_hidden()
