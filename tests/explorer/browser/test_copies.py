"""What the page gives away: scripts and commands that run, links, and files of its panels."""

import csv
import re
import runpy
import shlex
import sys
from io import BytesIO, StringIO
from pathlib import Path
from xml.etree import ElementTree as ET

import pytest
from PIL import Image
from playwright.sync_api import Page

from rocksteady.cli.app import main
from tests.explorer.browser.watched import Explorer, drawn, fragment, values

STATE = {"A": 2.1, "W": 1 / 3 + 1.6, "r": 0.7, "model": "nonlinear", "b": 0.6}
READOUT = "[data-panel='readout']"
NAMES = {"highest theta/alpha": "highest", "lowest theta/alpha": "lowest"}


def copied(page: Page, what: str) -> str:
    """Return what an entry of the page's menu copies."""
    page.locator("#menu summary[title^='Copy']").click()
    page.get_by_role("button", name=what, exact=True).first.click()
    drawn(page)
    area = page.locator("dialog[open] textarea")
    if area.count():  # the browser lets no page copy
        return area.input_value()
    text: str = page.evaluate("navigator.clipboard.readText()")
    return text


def opened(explorer: Explorer) -> Page:
    page = explorer.open(STATE, permissions=["clipboard-read", "clipboard-write"])
    assert values(page, READOUT)
    return page


@pytest.mark.slow
def test_copy_as_python_gives_a_script_that_prints_what_is_shown(
    explorer: Explorer, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    page = opened(explorer)
    script = tmp_path / "copied.py"
    script.write_text(copied(page, "Copy as Python"), encoding="utf-8")
    runpy.run_path(str(script), run_name="__main__")
    printed = dict(line.split(": ", 1) for line in capsys.readouterr().out.splitlines())
    shown = values(page, READOUT)
    assert printed["attractor"] == shown["kind"]
    assert float(printed["peak of |theta|/alpha"]) == float(shown["peak"])
    for words, name in NAMES.items():
        if name in shown and words in printed:
            assert float(printed[words]) == float(shown[name])


@pytest.mark.slow
def test_copy_as_command_gives_a_command_that_finds_what_is_shown(
    explorer: Explorer, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    page = opened(explorer)
    words = shlex.split(copied(page, "Copy as command"))
    assert words[0] == "rocksteady"
    monkeypatch.setattr(sys, "argv", words)
    with pytest.raises(SystemExit) as end:
        main()
    assert end.value.code == 0
    assert values(page, READOUT)["kind"] in capsys.readouterr().out


@pytest.mark.slow
def test_the_copied_link_opens_the_same_view(explorer: Explorer) -> None:
    page = opened(explorer)
    address = copied(page, "Copy link")
    assert address.startswith(explorer.file.as_uri() + "#v=1&")
    other = explorer.context().new_page()
    other.goto(address)
    drawn(other)
    assert values(other) == values(page)
    parts = set(address.partition("#")[2].split("&"))
    assert set(fragment(STATE)[1:].split("&")) < parts
    assert {"units=si", "h=2", "at=lab", "pA=2.5", "dr1=2.5", "start=rest"} < parts


@pytest.mark.slow
@pytest.mark.parametrize("panel", ["film", "strip"])
def test_each_panel_is_saved_as_a_picture_and_a_table(
    panel: str, explorer: Explorer, tmp_path: Path
) -> None:
    page = explorer.open()
    page.wait_for_timeout(500.0)
    root = page.locator(f"[data-panel='{panel}']")
    for kind in ("PNG", "SVG", "CSV"):
        root.locator("details.menu summary").click()
        with page.expect_download() as download:
            root.get_by_role("button", name=kind, exact=True).click()
        target = tmp_path / f"{panel}.{kind.lower()}"
        download.value.save_as(target)
        data = target.read_bytes()
        if kind == "PNG":
            picture = Image.open(BytesIO(data)).convert("RGB")
            assert len(picture.getcolors(2**24) or []) > 8
        elif kind == "SVG":
            assert ET.fromstring(data).tag.endswith("svg")
            assert not re.search(rb"<script|on\w+=|https?://(?!www\.w3\.org)", data)
        else:
            rows = list(csv.reader(StringIO(data.decode("utf-8-sig"))))
            assert len({len(row) for row in rows if row}) <= 2
            assert len(rows) > 1
