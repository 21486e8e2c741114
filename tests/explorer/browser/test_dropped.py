"""Files of ground motions dropped on the page: good ones are shaken with, others do nothing."""

import base64
import math
import re
from pathlib import Path

import numpy as np
import pytest
from playwright.sync_api import Page

import rocksteady as rs
from tests.explorer.browser.watched import Explorer, drawn, until, values

LINE = "[data-panel='quake'] .files"
NASTY = "<img src=x onerror=alert(1)>.csv"
DROP = """([name, content, megabytes]) => {
  const bytes = megabytes ? new Uint8Array(megabytes * 1e6)
    : Uint8Array.from(atob(content), letter => letter.charCodeAt(0));
  const data = new DataTransfer();
  data.items.add(new File([bytes], name));
  document.body.dispatchEvent(new DragEvent('drop', {
    dataTransfer: data, bubbles: true, cancelable: true }));
}"""
TAGS = "() => document.querySelectorAll('img, script, iframe, svg image, object').length"


def drop(page: Page, name: str, content: bytes, megabytes: int = 0) -> None:
    """Drop a file on the page, as a mouse does."""
    page.evaluate(DROP, [name, base64.b64encode(content).decode("ascii"), megabytes])


def record(end: str = "\n", head: str = "time [s], acceleration [m/s2]") -> bytes:
    """Return a sine of 2 Hz that fades, as a table of two columns."""
    times = 0.01 * np.arange(800)
    rows = 4.0 * np.exp(-0.3 * times) * np.sin(4.0 * math.pi * times)
    lines = [head, *(f"{t:.2f},{a:.8f}" for t, a in zip(times, rows, strict=True))]
    return (end.join(lines) + end).encode()


def told(page: Page) -> str:
    """Return what the page says of the files, once it has read them."""
    until(page, f'() => !/^(Reading|Or drop)/.test(document.querySelector("{LINE}").textContent)')
    return page.locator(LINE).inner_text()


def stands(page: Page) -> str:
    """Return what the page says of the block on the motion, once it is computed."""
    note = "[data-panel='quake'] .note"
    until(page, f"() => /the block (stands|falls)/i.test({text_of(note)})")
    return page.locator(note).inner_text()


def text_of(selector: str) -> str:
    return f'document.querySelector("{selector}").textContent'


@pytest.mark.slow
@pytest.mark.parametrize(
    ("name", "end"),
    [("two.txt", "\r"), (NASTY, "\n")],
    ids=["CR", "nasty name"],
)
def test_a_good_file_is_shaken_with_as_python_does(
    name: str, end: str, explorer: Explorer, tmp_path: Path
) -> None:
    page = explorer.open({"tab": "quake", "model": "linear"})
    tags = page.evaluate(TAGS)
    chosen = page.locator("[data-panel='quake'] select[aria-label='ground motion']")
    before = chosen.locator("option").count()
    drop(page, name, record(end))
    until(
        page,
        "before => document.querySelectorAll(\"[data-panel='quake'] "
        "select[aria-label='ground motion'] option\").length > before",
        before,
    )
    drawn(page)
    said = stands(page)
    file = tmp_path / "shaking.csv"
    file.write_bytes(record())
    motion = rs.read_record(file)
    block = rs.Block.rectangle(width=0.5, height=2.0, restitution=0.8)
    run = rs.simulate(block, motion, model=rs.Linear())
    peak = re.search(r"= ([\d.]+) % of α", said)
    assert peak is not None, said
    assert float(peak[1]) == pytest.approx(100.0 * run.peak, rel=1e-2)
    assert f"{len(run.impacts)} impact" in said
    assert page.evaluate(TAGS) == tags
    assert page.locator(".failed").count() == 0


@pytest.mark.slow
@pytest.mark.parametrize(
    ("name", "content"),
    [
        ("nan.csv", b"time [s],acceleration [g]\n0,0.1\n0.01,nan\n0.02,0.1\n"),
        ("binary.at2", bytes(range(256)) * 64),
        (NASTY, b"<svg onload=alert(1)>"),
    ],
    ids=lambda value: value if isinstance(value, str) and "<" not in value else "",
)
def test_a_bad_file_is_refused_in_a_line_and_changes_nothing(
    name: str, content: bytes, explorer: Explorer
) -> None:
    page = explorer.open({"tab": "quake"})
    tags, before = page.evaluate(TAGS), values(page)
    drop(page, name, content)
    line = told(page)
    assert line.strip()
    assert page.locator(f"{LINE}.refused").count() == 1
    assert page.evaluate(TAGS) == tags
    assert values(page) == before


@pytest.mark.slow
def test_a_file_of_100_mb_is_refused_without_being_read(explorer: Explorer) -> None:
    page = explorer.open({"tab": "quake"})
    drop(page, "large.csv", b"", 100)
    assert "100 MB" in told(page)


@pytest.mark.slow
def test_a_file_dropped_on_another_tab_leads_to_its_own(explorer: Explorer) -> None:
    page = explorer.open()
    drop(page, "shaking.csv", record())
    until(page, "() => location.hash.includes('tab=quake')")
    assert page.url.startswith(explorer.file.as_uri())
