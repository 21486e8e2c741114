"""The panels of the point: motions that coexist are found by touch, and all panels follow."""

import pytest
from playwright.sync_api import Locator, Page

from tests.explorer.browser.watched import Explorer, drawn, link, turn_to, until, values

READOUT = "[data-panel='readout']"
POINTS = ({"A": 0.8, "W": 2.0}, {"A": 2.0, "W": 6.0}, {"A": 2.0, "W": 1.9})
FRESH = "() => !document.querySelector('.stale') && document.querySelector('.chip')"


def chips(page: Page) -> Locator:
    until(page, FRESH)
    return page.locator(f"{READOUT} .chip")


def canvas(page: Page, panel: str) -> dict[str, float]:
    place = page.locator(f"[data-panel='{panel}'] canvas")
    place.scroll_into_view_if_needed()
    box = place.bounding_box()
    assert box is not None
    return {name: float(value) for name, value in box.items()}  # type: ignore[arg-type]


@pytest.mark.slow
@pytest.mark.parametrize(
    ("state", "model"), list(zip(POINTS, ["linear", "nonlinear", "linear"], strict=True))
)
def test_each_motion_is_chosen_by_a_click(
    state: dict[str, float], model: str, explorer: Explorer
) -> None:
    page = explorer.open({**state, "model": model, "r": 0.8})
    found = chips(page)
    for k in range(found.count()):
        wanted = found.nth(k).evaluate("one => ({ ...one.dataset })")
        found.nth(k).click()
        drawn(page)
        shown = values(page, READOUT)
        assert shown["kind"] == wanted["kind"]
        assert shown.get("period", "0") == wanted["period"]
        if wanted["highest"] != "NaN":
            assert float(shown["highest"]) == pytest.approx(float(wanted["highest"]), abs=1e-9)
        pressed = [found.nth(i).get_attribute("aria-pressed") for i in range(found.count())]
        assert [one == "true" for one in pressed] == [i == k for i in range(found.count())]


@pytest.mark.slow
def test_the_other_motion_is_chosen_in_the_phase_portrait(explorer: Explorer) -> None:
    page = explorer.open({"A": 0.8, "W": 2.0, "r": 0.8})
    chips(page).nth(1).click()
    drawn(page)
    assert values(page, READOUT)["kind"] == "symmetric"
    box = canvas(page, "phase")
    hand = "document.querySelector(\"[data-panel='phase'] canvas\").style.cursor"
    for down in range(20, 80, 2):
        x, y = box["x"] + 0.55 * box["width"], box["y"] + 0.01 * down * box["height"]
        page.mouse.move(x, y)
        if page.evaluate(hand) == "pointer":
            page.mouse.click(x, y)
            break
    drawn(page)
    assert values(page, READOUT)["kind"] == "rest"
    assert "start" not in link(page)


@pytest.mark.slow
def test_the_time_history_moves_the_cursor_of_all_panels(explorer: Explorer) -> None:
    page = explorer.open({"A": 2.0, "W": 6.0})
    box = canvas(page, "history")
    scrub = page.locator("[data-panel='film'] input[type=range]")
    places = []
    for part in (0.3, 0.6, 0.9):
        page.mouse.move(box["x"] + part * box["width"], box["y"] + 0.5 * box["height"])
        page.mouse.down()
        page.mouse.up()
        drawn(page, 3)
        places.append(float(scrub.input_value()))
    assert places == sorted(set(places))
    pictures = []
    for panel in ("phase", "section"):
        picture = f"document.querySelector(\"[data-panel='{panel}'] canvas\").toDataURL()"
        before = page.evaluate(picture)
        page.locator("[data-panel='history'] canvas").press("Shift+ArrowLeft")
        drawn(page, 3)
        pictures.append(page.evaluate(picture) != before)
    assert pictures == [True, True]


@pytest.mark.slow
def test_a_start_that_there_is_not_leaves_the_last_motion_and_says_why(explorer: Explorer) -> None:
    page = explorer.open({"A": 2.0, "W": 4.0, "start": "steady"})
    before = values(page, READOUT)
    turn_to(page, {"A": 0.1, "W": 4.0, "start": "steady"})
    note = page.locator(f"{READOUT} .note").inner_text()
    assert "there is none of order 1" in note
    assert "Raise the amplitude to 0.260201" in note
    assert values(page, READOUT) == before
    turn_to(page, {"A": 0.1, "W": 4.0})
    assert page.locator(".panel.failed:visible").count() == 0
    assert values(page, READOUT)["kind"] == "rest"


@pytest.mark.slow
def test_what_is_seen_in_engineering_units_has_the_same_values(explorer: Explorer) -> None:
    page = explorer.open({"A": 2.0, "W": 6.0, "units": "none"})
    plain = values(page, READOUT)
    turn_to(page, {"A": 2.0, "W": 6.0})
    shown = values(page, READOUT)
    top = float(shown.pop("top"))
    assert shown == plain
    # 2 m high, rotated by 0.085 alpha about its corner.
    assert 1e3 * top == pytest.approx(2e3 * float(plain["highest"]) * 0.244979, rel=0.03)
    text = page.locator(f"{READOUT} [data-name='highest']").text_content()
    assert text
    assert text.endswith("°")


@pytest.mark.slow
def test_on_a_phone_the_readout_leaves_most_of_the_screen(explorer: Explorer) -> None:
    page = explorer.open({"A": 2.0, "W": 1.9}, size=(360, 780), has_touch=True)
    chips(page)
    page.mouse.wheel(0.0, 2000.0)
    until(page, f'() => document.querySelector("{READOUT}").getBoundingClientRect().top < 5')
    box = page.locator(READOUT).bounding_box()
    assert box is not None
    assert box["height"] < 0.3 * 780.0
    assert page.evaluate("document.documentElement.scrollWidth") <= 360
