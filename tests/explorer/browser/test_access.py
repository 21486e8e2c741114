"""Names, contrast and focus: what a screen reader and a keyboard find."""

import re

import pytest
from playwright.sync_api import Page

from tests.explorer.browser.watched import Explorer, drawn, link, turn_to, until

TABS = ("explore", "basins", "pulse", "quake", "design")
NAMELESS = """() => [...document.querySelectorAll(
  'button, a[href], input, select, textarea, canvas, section, [role], summary')].filter(one => {
    if (!one.checkVisibility() || one.closest('[aria-hidden]')) return false;
    const by = one.getAttribute('aria-labelledby');
    const name = one.getAttribute('aria-label') || (by && document.getElementById(by)?.textContent)
      || one.labels?.[0]?.textContent || one.textContent || one.getAttribute('title');
    return !name?.trim() && !['live', 'notice'].includes(one.id);
  }).map(one => one.outerHTML.slice(0, 120))"""
DESCRIBED = """() => [...document.querySelectorAll('.panel .canvas canvas')].every(
  one => !one.checkVisibility() || one.getAttribute('aria-label')?.length > 20)"""
CONTRAST = """() => {
  const light = ([r, g, b]) => {
    const part = v => (v /= 255) <= 0.04045 ? v / 12.92 : ((v + 0.055) / 1.055) ** 2.4;
    return 0.2126 * part(r) + 0.7152 * part(g) + 0.0722 * part(b);
  };
  const parts = text => text.match(/[\\d.]+/g).map(Number);
  const paper = one => {
    for (; one; one = one.parentElement) {
      const found = parts(getComputedStyle(one).backgroundColor);
      if (found.length < 4 || found[3] > 0) return found;
    }
    return [255, 255, 255];
  };
  const poor = [];
  for (const one of document.querySelectorAll('body *')) {
    const own = [...one.childNodes].some(node => node.nodeType === 3 && node.textContent.trim());
    if (!own || !one.checkVisibility()) continue;
    if (one.closest('.unseen, .skip, #still, option, :disabled')) continue;
    const [a, b] = [light(parts(getComputedStyle(one).color)), light(paper(one))];
    const ratio = (Math.max(a, b) + 0.05) / (Math.min(a, b) + 0.05);
    if (ratio < 4.5) poor.push(`${ratio.toFixed(2)} ${one.outerHTML.slice(0, 100)}`);
  }
  return poor;
}"""
FOCUSED = """() => {
  const one = document.activeElement, style = getComputedStyle(one);
  const box = one.getBoundingClientRect();
  return { name: one.id || one.className || one.tagName, ring: style.outlineStyle !== 'none',
    page: one === document.body, top: box.top + scrollY, seen: box.width > 0 };
}"""


@pytest.mark.slow
@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_everything_has_a_name_and_text_stands_out(scheme: str, explorer: Explorer) -> None:
    page = explorer.open(color_scheme=scheme)
    for tab in TABS:
        turn_to(page, {"tab": tab})
        until(page, f"() => ({NAMELESS})().length === 0")
        assert (tab, page.evaluate(CONTRAST)) == (tab, [])


@pytest.mark.slow
def test_ids_are_unique_and_what_refers_to_one_finds_it(explorer: Explorer) -> None:
    page = explorer.open()
    ids: list[str] = page.evaluate("[...document.querySelectorAll('[id]')].map(one => one.id)")
    assert len(ids) == len(set(ids))
    used: list[str] = page.evaluate(
        """['for', 'aria-labelledby', 'aria-describedby', 'aria-controls'].flatMap(name =>
          [...document.querySelectorAll(`[${name}]`)].flatMap(
            one => one.getAttribute(name).split(' ')))"""
    )
    assert set(used) <= set(ids)


@pytest.mark.slow
def test_each_picture_is_described_by_a_sentence(explorer: Explorer) -> None:
    page = explorer.open()
    for tab in TABS:
        turn_to(page, {"tab": tab})
        until(page, DESCRIBED)
        for canvas in page.locator(".panel:visible .canvas canvas").all():
            sentence = str(canvas.get_attribute("aria-label"))
            assert len(sentence) > 20, (tab, sentence)
            assert not re.search(r"<[/\w]|\bfalse\b|\[object", sentence), (tab, sentence)
            assert not re.search("NaN|undefined|null|Infinity", sentence), (tab, sentence)


@pytest.mark.slow
def test_focus_passes_through_the_page_in_the_order_of_sight(explorer: Explorer) -> None:
    page = explorer.open()
    passed = tour(page)
    assert passed[0]["name"] == "skip"
    assert all(stop["ring"] for stop in passed), [s for s in passed if not s["ring"]]
    names = [str(stop["name"]) for stop in passed]
    assert names.index("tab-explore") < names.index("in-a_g") < names.index("CANVAS")
    assert len(passed) > 15


def tour(page: Page) -> list[dict[str, object]]:
    """Return where Tab leads, from the top of the page until it leaves it."""
    stops: list[dict[str, object]] = []
    for _ in range(200):
        page.keyboard.press("Tab")
        stop = page.evaluate(FOCUSED)
        if stop["page"]:
            break
        stops.append(stop)
    return stops


@pytest.mark.slow
def test_text_at_twice_its_size_stays_inside(explorer: Explorer) -> None:
    """A zoom of 200 % is a page of half the width."""
    page = explorer.open(size=(720, 450), device_scale_factor=2)
    assert page.evaluate("document.documentElement.scrollWidth") <= 720
    assert page.locator("#in-a_g").is_visible()


@pytest.mark.slow
def test_what_is_touched_is_large_enough_on_a_phone(explorer: Explorer) -> None:
    page = explorer.open(size=(360, 740), has_touch=True, is_mobile=True)
    for tab in TABS:
        turn_to(page, {"tab": tab})
        small: list[str] = page.evaluate(
            """() => [...document.querySelectorAll('button, select, input[type=number]')].filter(
              one => one.checkVisibility() && one.getBoundingClientRect().height < 44
            ).map(one => one.outerHTML.slice(0, 80))"""
        )
        assert (tab, small) == (tab, [])


@pytest.mark.slow
def test_the_map_stays_in_its_place_whatever_the_point_is(explorer: Explorer) -> None:
    page = explorer.open()
    tops = set()
    for place in ({}, {"A": 0.8, "W": 2.0}, {"A": 2.0, "W": 6.0}, {"A": 5.0, "W": 1.0}):
        turn_to(page, place)
        page.wait_for_timeout(150.0)
        tops.add(page.evaluate("document.getElementById('panel-map').offsetTop"))
    assert len(tops) == 1
    strip = page.locator("[data-panel='strip'] canvas").bounding_box()
    assert strip is not None
    assert strip["y"] + strip["height"] < 1.05 * page.evaluate("innerHeight")


@pytest.mark.slow
def test_a_worked_example_is_chosen_by_keys_and_undone_by_back(explorer: Explorer) -> None:
    page = explorer.open({"A": 1.5})
    page.locator("#menu summary[title='Worked examples']").focus()
    page.keyboard.press("Enter")
    page.keyboard.press("Tab")
    page.keyboard.press("Tab")
    page.keyboard.press("Enter")
    drawn(page)
    assert link(page) == {"v": "1", "A": "0.8", "W": "2"}
    page.go_back()
    drawn(page)
    assert link(page) == {"v": "1", "A": "1.5"}


@pytest.mark.slow
def test_a_tab_says_what_to_drag_and_has_the_controls_that_count(explorer: Explorer) -> None:
    page = explorer.open()
    leads = set()
    for tab in TABS:
        turn_to(page, {"tab": tab})
        leads.add(page.locator("#lead").inner_text())
        assert page.locator("#in-units").is_visible() == (tab not in {"quake", "design"})
        panels = page.locator("[role='tabpanel']")
        assert panels.get_attribute("aria-labelledby") == f"tab-{tab}"
    assert len(leads) == len(TABS)
    assert all("Drag" in lead for lead in leads)


@pytest.mark.slow
def test_uplift_is_that_of_the_equations(explorer: Explorer) -> None:
    """The linear equations lift at alpha g, the full ones at g tan alpha, which is width/height."""
    page = explorer.open({"b": 1.0, "h": 2.0})
    assert "uplift at 0.464 g" in page.locator("#measures").inner_text()
    turn_to(page, {"b": 1.0, "h": 2.0, "model": "nonlinear"})
    assert "uplift at 0.500 g" in page.locator("#measures").inner_text()
