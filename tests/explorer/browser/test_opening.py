"""The page as it opens: anywhere, in any size, with nothing but itself."""

import html
import re
from pathlib import Path

import pytest
from playwright.sync_api import FrameLocator, Page

from tests.explorer.browser.watched import Explorer, drawn, turn_to, until, values

TABS = ("explore", "basins", "pulse", "quake", "design")
MOVED = "([canvas, before]) => canvas.toDataURL() !== before"
ANY_INK = """canvas => {
  const { width, height } = canvas;
  const cells = new Uint32Array(
    canvas.getContext('2d').getImageData(0, 0, width, height).data.buffer);
  return new Set(cells).size;
}"""


def panels(page: Page) -> list[str]:
    found: list[str] = page.locator("[data-panel]:visible").evaluate_all(
        "all => all.map(one => one.dataset.panel)"
    )
    return found


@pytest.mark.parametrize("tab", TABS)
def test_each_tab_opens_with_a_result(tab: str, explorer: Explorer) -> None:
    page = explorer.open({"tab": tab})
    assert panels(page)
    for canvas in page.locator(".panel:visible .canvas canvas").all():
        canvas.scroll_into_view_if_needed()
        name = canvas.evaluate("one => one.closest('[data-panel]').dataset.panel")
        until(page, f"canvas => ({ANY_INK})(canvas) > 8", canvas.element_handle())
        assert page.locator(f"[data-panel='{name}'].failed").count() == 0


NO_FRAMES = "window.requestAnimationFrame = () => 1;"


@pytest.mark.slow
@pytest.mark.parametrize("tab", TABS)
def test_panels_are_described_and_take_keys_before_their_first_frame(
    tab: str, explorer: Explorer
) -> None:
    """A panel was asked for its sentence before it had been given a block."""
    page = explorer.context().new_page()
    page.add_init_script(NO_FRAMES)
    page.goto(explorer.file.as_uri() + f"#v=1&tab={tab}")
    page.locator(".panel:visible .canvas canvas").first.wait_for()
    for canvas in page.locator(".panel:visible .canvas canvas").all():
        until(page, "canvas => canvas.getAttribute('aria-label')", canvas.element_handle())
    page.keyboard.press("]")
    page.keyboard.press("+")


@pytest.mark.slow
def test_the_first_view_says_what_to_drag_and_what_it_shows(explorer: Explorer) -> None:
    page = explorer.open()
    assert "map" in panels(page)
    assert "film" in panels(page)
    assert "drag" in page.locator("#lead").inner_text().lower()
    assert values(page)
    assert page.locator("#notice").is_hidden()
    assert page.locator("#refusal").is_hidden()


def framed(explorer: Explorer, folder: Path, attributes: str) -> FrameLocator:
    """Return the page inside a page of the manual."""
    outer = folder / "manual.html"
    address = html.escape(explorer.file.as_uri() + "#v=1&A=1.5&units=none")
    frame = f'<iframe src="{address}" width="900" height="700" {attributes}></iframe>'
    outer.write_text(f"<!doctype html><title>Manual</title>{frame}", encoding="utf-8")
    page = explorer.context().new_page()
    page.goto(outer.as_uri())
    inner = page.frame_locator("iframe")
    inner.locator("html[data-ready='true']").wait_for()
    return inner


@pytest.mark.slow
@pytest.mark.parametrize("attributes", ["", 'sandbox="allow-scripts"'])
def test_the_page_runs_in_a_frame_of_another_page(
    attributes: str, explorer: Explorer, tmp_path: Path
) -> None:
    page = framed(explorer, tmp_path, attributes)
    page.locator("[data-panel]").first.wait_for()
    field = page.locator("#in-A")
    assert field.input_value() == "1.5"
    field.fill("2.5")
    field.press("Enter")
    assert field.get_attribute("data-value") == "2.5"


@pytest.mark.slow
@pytest.mark.parametrize("missing", ["WebAssembly", "DecompressionStream"])
def test_without_what_it_needs_the_page_says_so_and_shows_a_picture(
    missing: str, explorer: Explorer
) -> None:
    page = explorer.context().new_page()
    page.add_init_script(f"delete globalThis.{missing};")
    page.goto(explorer.file.as_uri())
    until(page, "() => document.documentElement.dataset.ready === 'false'")
    assert page.locator("#refusal").is_visible()
    assert re.search("WebAssembly|too old", page.locator("#cause").inner_text())
    assert page.locator("#still svg").bounding_box() is not None
    explorer.watch.forgive(r"console: Error: this browser")


def test_without_scripts_the_page_says_so_and_shows_a_picture(explorer: Explorer) -> None:
    page = explorer.context(java_script_enabled=False).new_page()
    page.goto(explorer.file.as_uri())
    assert page.locator("noscript").is_visible()
    assert page.locator("#still svg").bounding_box() is not None


@pytest.mark.slow
@pytest.mark.parametrize("width", [320, 720])
def test_no_width_needs_scrolling_sideways(width: int, explorer: Explorer) -> None:
    page = explorer.open(size=(width, 800))
    for tab in TABS:
        turn_to(page, {"tab": tab})
        wide: list[str] = page.evaluate(
            """() => [...document.querySelectorAll('body *')].filter(one => {
              const box = one.getBoundingClientRect();
              if (!box.width || box.right <= innerWidth + 1) return false;
              for (let above = one; above !== document.body; above = above.parentElement) {
                if (getComputedStyle(above).overflowX !== 'visible') return false;
              }
              return true;
            }).map(one => `${one.tagName} ${one.id || one.className}`)"""
        )
        assert (tab, wide) == (tab, [])
        assert page.evaluate("document.documentElement.scrollWidth") <= width, tab


@pytest.mark.slow
def test_the_page_follows_the_theme_of_the_system_and_its_switch(explorer: Explorer) -> None:
    light = explorer.open(color_scheme="light")
    paper = "getComputedStyle(document.body.querySelector('.panel')).backgroundColor"
    bright = light.evaluate(paper)
    dark = explorer.open(color_scheme="dark")
    assert dark.evaluate(paper) != bright
    dark.locator("#in-look").select_option("light")
    drawn(dark)
    assert dark.evaluate(paper) == bright
    dark.emulate_media(color_scheme="light")
    light.emulate_media(color_scheme="dark")
    drawn(light)
    assert light.evaluate(paper) != bright
    assert dark.evaluate(paper) == bright


@pytest.mark.slow
def test_the_present_view_prints(explorer: Explorer) -> None:
    page = explorer.open()
    page.emulate_media(media="print")
    drawn(page)
    assert page.locator("#tabs").is_hidden()
    assert page.locator(".bar").first.is_hidden()
    assert page.locator(".panel canvas").first.is_visible()
    assert page.pdf().startswith(b"%PDF")


@pytest.mark.slow
def test_with_reduced_motion_the_block_stands_still_until_it_is_played(explorer: Explorer) -> None:
    page = explorer.open({"A": 2, "W": 2})
    film = page.locator("[data-panel='film']")
    play, canvas = film.get_by_role("button", name="Play"), film.locator("canvas")
    picture = "canvas => canvas.toDataURL()"
    before = canvas.evaluate(picture)
    drawn(page, 20)
    assert canvas.evaluate(picture) == before
    play.click()
    until(page, MOVED, [canvas.element_handle(), before])
    film.get_by_role("button", name="Pause").click()
    drawn(page)
    before = canvas.evaluate(picture)
    drawn(page, 20)
    assert canvas.evaluate(picture) == before


@pytest.mark.slow
def test_the_block_rocks_by_itself_where_motion_is_welcome(explorer: Explorer) -> None:
    page = explorer.open(reduced_motion="no-preference")
    canvas = page.locator("[data-panel='film'] canvas")
    canvas.scroll_into_view_if_needed()
    before = canvas.evaluate("canvas => canvas.toDataURL()")
    until(page, MOVED, [canvas.element_handle(), before])


@pytest.mark.slow
def test_jobs_run_in_workers(explorer: Explorer) -> None:
    page = explorer.open()
    drawn(page)
    assert len(page.workers) >= 2


@pytest.mark.slow
def test_a_motion_of_millions_of_impacts_leaves_the_page_free(explorer: Explorer) -> None:
    """A lossless block on crests that just lift it: a period has a million impacts."""
    page = explorer.open({"A": 1.0000001, "W": 58.486833344963635, "r": 1})
    text = page.locator("[data-panel='readout']").inner_text()
    assert "not known yet" in text or "motions do not settle" in text
    page.locator("#tab-design").click(timeout=3000)
    assert "design" in panels(page)


@pytest.mark.slow
def test_a_dark_page_is_printed_in_light_colours(explorer: Explorer) -> None:
    page = explorer.open(color_scheme="dark")
    corner = """() => [...document.querySelector("[data-panel='history'] canvas")
      .getContext('2d').getImageData(2, 2, 1, 1).data]"""
    until(page, f"() => ({corner})()[3] === 255")  # panels are painted one a frame
    dark = page.evaluate(corner)
    page.evaluate("dispatchEvent(new Event('beforeprint'))")
    printed = page.evaluate(corner)
    page.evaluate("dispatchEvent(new Event('afterprint'))")
    assert sum(dark[:3]) < 200
    assert sum(printed[:3]) > 600
    until(page, f"dark => ({corner})().join() === dark.join()", dark)
