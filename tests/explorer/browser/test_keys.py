"""Keys, menus, help and tables: what they do, and from whom they take nothing."""

import re
from itertools import product

import pytest
from playwright.sync_api import Page

from tests.explorer.browser.watched import Explorer, drawn, link, until

REFUSED = """() => Object.defineProperty(navigator, 'clipboard',
  { value: { writeText: () => Promise.reject(new Error('refused')) } })"""
FOCUSED = "() => document.activeElement?.id || document.activeElement?.tagName"


def press(page: Page, *keys: str) -> None:
    for key in keys:
        page.keyboard.press(key)
    drawn(page)


@pytest.mark.slow
def test_keys_of_the_page_change_the_view(explorer: Explorer) -> None:
    page = explorer.open()
    for key, tab in zip("2345", ("basins", "pulse", "quake", "design"), strict=True):
        press(page, key)
        assert link(page)["tab"] == tab
    press(page, "1", "b", "L")
    assert link(page) == {"v": "1", "by": "a", "log": "1"}
    press(page, "B", "l")
    assert link(page) == {"v": "1"}


@pytest.mark.slow
def test_keys_are_not_taken_from_numbers_and_lists(explorer: Explorer) -> None:
    page = explorer.open()
    for name, keys in product(("#in-a_g", "#in-units"), "2bL?e[+"):
        page.locator(name).focus()
        page.keyboard.press(keys)
        drawn(page)
        assert "tab" not in link(page)
        assert "by" not in link(page)
        assert page.locator("dialog, details.menu[open]").count() == 0


@pytest.mark.slow
def test_keys_of_the_browser_are_left_to_it(explorer: Explorer) -> None:
    page = explorer.open()
    before = page.url
    for keys in ("Control+b", "Alt+2", "Meta+l"):
        press(page, keys)
        assert page.url == before, keys


@pytest.mark.slow
def test_help_takes_the_focus_and_gives_it_back(explorer: Explorer) -> None:
    page = explorer.open()
    page.locator("#in-f_hz").focus()
    page.locator("#help-button").focus()
    press(page, "?")
    dialog = page.locator("dialog#help")
    assert dialog.get_attribute("aria-labelledby") == "help-title"
    assert page.evaluate("() => document.activeElement.closest('dialog')?.id") == "help"
    for title in page.locator(".panel:visible h2").all_inner_texts():
        assert title in dialog.inner_text()
    assert all(words.strip() for words in dialog.locator("dd").all_inner_texts())
    press(page, "2")
    assert "tab" not in link(page)
    press(page, "Escape")
    assert dialog.count() == 0
    assert page.evaluate(FOCUSED) == "help-button"


@pytest.mark.slow
def test_keys_can_be_switched_off_and_on_again(explorer: Explorer) -> None:
    page = explorer.open()
    for on in (False, True):
        page.locator("#help-button").click()
        page.locator("dialog#help input").set_checked(on)
        page.locator("dialog#help button").click()
        press(page, "2")
        assert ("tab" in link(page)) == on


@pytest.mark.slow
def test_a_menu_opens_by_a_key_and_closes_without_losing_the_focus(explorer: Explorer) -> None:
    page = explorer.open()
    press(page, "e")
    menu = page.locator("[data-panel='map'] details.menu")
    assert menu.get_attribute("open") is not None
    assert page.evaluate("() => document.activeElement.textContent") == "PNG"
    press(page, "Escape")
    assert menu.get_attribute("open") is None
    assert page.evaluate("() => document.activeElement.tagName") == "SUMMARY"
    page.locator("#menu summary[title^='Copy']").click()
    page.locator("#in-a_g").click()
    assert page.locator("details.menu[open]").count() == 0


@pytest.mark.slow
def test_a_text_that_may_not_be_copied_is_shown_and_selected(explorer: Explorer) -> None:
    page = explorer.open({"A": 1.5})
    page.evaluate(REFUSED)
    page.locator("#menu summary[title^='Copy']").click()
    page.locator("#menu button", has_text="Copy as command").click()
    area = page.locator("dialog textarea")
    area.wait_for()
    text = area.input_value()
    assert text.startswith("rocksteady attractor -A 1.5 -W 3 ")
    assert page.evaluate("() => document.getSelection().toString()") == text
    press(page, "Escape")
    assert page.locator("dialog").count() == 0


@pytest.mark.slow
def test_tables_name_their_rows_and_show_two_hundred_at_most(explorer: Explorer) -> None:
    page = explorer.open()
    shown = 0
    for panel in page.locator(".panel:visible").filter(has=page.locator(".tabled")).all():
        panel.locator(".tabled summary").click()
        table = panel.locator(".tabled table")
        table.wait_for()
        until(page, "table => table.rows.length > 1", table.element_handle())
        rows = table.locator("tbody tr").count()
        words = table.locator("caption").inner_text()
        found = re.search(r"(?:first (\d+) of )?(\d+) rows?$", words)
        assert found, words
        assert rows == int(found[1] or found[2]) <= 200
        head = table.locator("th")
        assert head.count() == table.locator("tbody tr").first.locator("td").count()
        assert not re.search("NaN|undefined|null", table.inner_text())
        shown += 1
        panel.locator(".tabled summary").click()
    assert shown >= 5
