"""Pointer and keys on the map and the film: what is dragged, zoomed, undone and stepped."""

import math
from collections.abc import Iterator
from contextlib import contextmanager

import pytest
from playwright.sync_api import Page

from rocksteady.show.style.tokens import LIGHT
from tests.explorer.browser.watched import Explorer, drawn, link, until, values

MAP = "[data-panel='map'] canvas"
FILM = "[data-panel='film'] canvas"
DRAG = """async (canvas, [[x0, y0], [x1, y1]]) => {
  for (let k = 1; k <= 200; k += 1) {
    const { left, top, width, height } = canvas.getBoundingClientRect(), part = k / 200;
    const x = x0 + part * (x1 - x0), y = y0 + part * (y1 - y0) + 0.03 * Math.sin(9 * part);
    canvas.dispatchEvent(new PointerEvent('pointermove', {
      pointerId: 1, pointerType: 'mouse', bubbles: true, isPrimary: true, buttons: 1,
      clientX: left + x * width, clientY: top + y * height }));
    if (k % 4 === 0) await new Promise(requestAnimationFrame);
  }
}"""
"""200 moves of the pointer, four a frame."""
WINDOW = {"w0": 0.5, "w1": 8.0, "a0": 0.0, "a1": 6.0}


def at(page: Page, ratio: float, amplitude: float) -> tuple[float, float]:
    """Return the pixel of a point of the map whose window has not been changed.

    Two clicks tell where points lie, so that no margin of the picture is known here.
    """
    known = []
    for x, y in ((0.35, 0.35), (0.65, 0.55)):
        page.mouse.click(*pixel(page, x, y))
        settled(page)
        shown = values(page, "#controls")
        known.append((x, y, float(shown["W"]), float(shown["A"])))
        page.wait_for_timeout(400.0)  # two clicks at once are a double click
    (x0, y0, w0, a0), (x1, y1, w1, a1) = known
    return (
        x0 + (ratio - w0) * (x1 - x0) / (w1 - w0),
        y0 + (amplitude - a0) * (y1 - y0) / (a1 - a0),
    )


def pixel(page: Page, x: float, y: float) -> tuple[float, float]:
    """Return the pixel of a place of the map, given in parts of its picture."""
    box = page.locator(MAP).bounding_box()
    assert box is not None
    return box["x"] + x * box["width"], box["y"] + y * box["height"]


def settled(page: Page) -> None:
    """Wait until the motions that coexist at the point are known."""
    drawn(page)
    until(page, "() => !document.querySelector(\"[data-panel='readout'] .stale\")")


@contextmanager
def pressed(page: Page, *keys: str) -> Iterator[None]:
    for key in keys:
        page.keyboard.down(key)
    yield
    for key in keys:
        page.keyboard.up(key)


def window_of(page: Page) -> dict[str, float]:
    found = link(page)
    return {name: float(found.get(name, default)) for name, default in WINDOW.items()}


@pytest.mark.slow
def test_a_click_on_the_map_sets_the_point_and_all_that_follows(explorer: Explorer) -> None:
    page = explorer.open()
    before = values(page)
    page.mouse.click(*pixel(page, *at(page, 5.0, 3.0)))
    drawn(page)
    after = values(page)
    assert math.isclose(float(after["W"]), 5.0, abs_tol=0.05)
    assert math.isclose(float(after["A"]), 3.0, abs_tol=0.05)
    assert (float(link(page)["W"]), float(link(page)["A"])) == (
        float(after["W"]),
        float(after["A"]),
    )
    assert after["highest"] != before["highest"]


@pytest.mark.slow
def test_200_events_of_a_drag_leave_the_point_where_it_is_dropped(explorer: Explorer) -> None:
    page = explorer.open()
    path = [at(page, 2.0, 1.0), at(page, 6.5, 4.5)]
    entries, place = page.evaluate("history.length"), page.locator(MAP).bounding_box()
    page.mouse.move(*pixel(page, *path[0]))
    page.mouse.down()
    page.locator(MAP).evaluate(DRAG, path)
    page.mouse.move(*pixel(page, *path[1]))
    page.mouse.up()
    settled(page)
    dropped = values(page)
    assert page.locator(MAP).bounding_box() == place, "the map moves away from the pointer"
    assert math.isclose(float(dropped["W"]), 6.5, abs_tol=0.05)
    assert math.isclose(float(dropped["A"]), 4.5, abs_tol=0.05)
    assert page.evaluate("history.length") <= entries + 1
    # A page that is opened there says the same.
    other = explorer.open(page.evaluate("location.hash"))
    assert values(other, "[data-panel='readout']") == values(page, "[data-panel='readout']")


@pytest.mark.slow
def test_the_wheel_zooms_about_the_pointer_and_back_undoes_it(explorer: Explorer) -> None:
    page = explorer.open()
    page.mouse.move(*pixel(page, *at(page, 3.0, 2.0)))
    page.mouse.wheel(0.0, -400.0)
    until(page, "() => location.hash.includes('w1=')")
    near = window_of(page)
    assert near["w1"] - near["w0"] < 7.5
    assert near["w0"] < 3.0 < near["w1"]
    assert near["a0"] < 2.0 < near["a1"]
    page.go_back()
    drawn(page)
    assert window_of(page) == WINDOW


@pytest.mark.slow
@pytest.mark.parametrize("key", ["Shift", ""])
def test_a_box_or_a_key_zooms_and_0_shows_the_whole(key: str, explorer: Explorer) -> None:
    page = explorer.open()
    if key:
        one, other = at(page, 2.0, 1.0), at(page, 4.0, 3.0)
        page.mouse.move(*pixel(page, *one))
        with pressed(page, key):
            page.mouse.down()
            page.mouse.move(*pixel(page, *other), steps=5)
            page.mouse.up()
        drawn(page)
        found = window_of(page)
        assert found == pytest.approx({"w0": 2.0, "w1": 4.0, "a0": 1.0, "a1": 3.0}, abs=0.05)
    else:
        page.locator(MAP).focus()
        page.keyboard.press("+")
        drawn(page)
        assert window_of(page)["w1"] < WINDOW["w1"]
    page.locator(MAP).focus()
    page.keyboard.press("0")
    drawn(page)
    assert window_of(page) == WINDOW


@pytest.mark.slow
def test_a_double_click_shows_the_whole_again(explorer: Explorer) -> None:
    page = explorer.open({"w0": 2, "w1": 4, "a0": 1, "a1": 3})
    before = values(page, "#controls")
    box = page.locator(MAP).bounding_box()
    assert box is not None
    page.mouse.dblclick(box["x"] + 0.4 * box["width"], box["y"] + 0.4 * box["height"])
    drawn(page)
    assert window_of(page) == WINDOW
    assert values(page, "#controls") == before


@pytest.mark.slow
def test_the_keyboard_alone_reaches_and_moves_everything(explorer: Explorer) -> None:
    page = explorer.open()
    before = values(page, "#controls")
    for _ in range(80):
        page.keyboard.press("Tab")
        if page.evaluate(f'document.activeElement === document.querySelector("{MAP}")'):
            break
    else:
        pytest.fail("Tab does not reach the map")
    page.keyboard.press("ArrowRight")
    one = float(values(page, "#controls")["W"]) - float(before["W"])
    drawn(page)
    with pressed(page, "Shift"):
        page.keyboard.press("ArrowUp")
    drawn(page)
    moved = values(page, "#controls")
    assert one > 0.0
    assert float(moved["A"]) > float(before["A"])
    regions = set()
    for _ in range(4):
        page.keyboard.press("]")
        drawn(page)
        regions.add(values(page, "#controls")["W"] + " " + values(page, "#controls")["A"])
    assert len(regions) > 1
    for key, tab in zip("12345", ("explore", "basins", "pulse", "quake", "design"), strict=True):
        page.keyboard.press("Escape")
        page.evaluate("document.activeElement.blur()")
        page.keyboard.press(key)
        drawn(page)
        assert link(page).get("tab", "explore") == tab


@pytest.mark.slow
def test_the_film_is_played_stepped_and_scrubbed_by_keys(explorer: Explorer) -> None:
    page = explorer.open()
    film = page.locator(FILM)
    film.focus()
    picture = "document.querySelector(\"[data-panel='film'] canvas\").toDataURL()"
    first = page.evaluate(picture)
    for _ in range(24):
        page.keyboard.press(".")
    drawn(page)
    later = page.evaluate(picture)
    assert later != first
    for _ in range(24):
        page.keyboard.press(",")
    drawn(page)
    assert page.evaluate(picture) == first
    page.keyboard.press("Space")
    until(page, f"first => {picture} !== first", first)
    page.keyboard.press("Space")
    scrub = page.locator("[data-panel='film'] input[type=range]")
    scrub.fill("0")
    drawn(page)
    assert page.evaluate(picture) == first


def channels(colour: str) -> list[int]:
    """Return red, green and blue."""
    return [int(colour[k : k + 2], 16) for k in (1, 3, 5)]


@pytest.mark.slow
def test_the_block_lies_where_it_overturns(explorer: Explorer) -> None:
    page = explorer.open({"A": 6, "W": 2})
    assert "overturn" in values(page)
    scrub = page.locator("[data-panel='film'] input[type=range]")
    scrub.fill("1000")
    drawn(page)
    lying = page.locator(FILM).evaluate(
        """(canvas, [falls, rocks]) => {
          const { width, height } = canvas;
          const { data } = canvas.getContext('2d').getImageData(0, 0, width, height);
          const is = (k, colour) => colour.every((value, j) => data[k + j] === value);
          let dark = 0, blue = 0;
          for (let k = 0; k < data.length; k += 4) {
            if (is(k, falls)) dark += 1;
            if (is(k, rocks)) blue += 1;
          }
          return [dark, blue];
        }""",
        [channels(LIGHT.falls), channels(LIGHT.rocks)],
    )
    assert lying[0] > 2000
    assert lying[1] == 0


@pytest.mark.slow
def test_two_fingers_zoom_the_map(explorer: Explorer) -> None:
    page = explorer.open(size=(400, 800), has_touch=True)
    canvas = page.locator(MAP)
    canvas.scroll_into_view_if_needed()
    canvas.evaluate(
        """canvas => {
          const { left, top, width, height } = canvas.getBoundingClientRect();
          const send = (type, id, x, y) => canvas.dispatchEvent(new PointerEvent(type, {
            pointerId: id, pointerType: 'touch', bubbles: true, cancelable: true, button: 0,
            isPrimary: id === 1, clientX: left + x * width, clientY: top + y * height }));
          send('pointerdown', 1, 0.45, 0.4); send('pointerdown', 2, 0.55, 0.4);
          for (let k = 1; k <= 10; k += 1) {
            send('pointermove', 1, 0.45 - 0.02 * k, 0.4);
            send('pointermove', 2, 0.55 + 0.02 * k, 0.4);
          }
          send('pointerup', 1, 0.25, 0.4); send('pointerup', 2, 0.75, 0.4);
        }"""
    )
    drawn(page)
    assert window_of(page)["w1"] - window_of(page)["w0"] < 4.0
