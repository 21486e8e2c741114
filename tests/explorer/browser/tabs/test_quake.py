"""Earthquake tab: the motion of a formula, files opened and dropped, good, bad and hostile."""

import math
from pathlib import Path

import numpy as np
import pytest
from playwright.sync_api import Page

from rocksteady import Block, Linear, Nonlinear, Record, read_record, simulate, write_explorer
from tests.explorer.browser.watched import Explorer, drawn, link, until, values
from tests.explorer.parts.physics.test_recordfile import BAD, GOOD, NAMES

QUAKE = {"tab": "quake"}
LINE = "#panel-quake .files"
DROP = """files => {
  const carried = new DataTransfer();
  for (const { name, text, size } of files) {
    carried.items.add(new File([size ? new Uint8Array(size) : text], name));
  }
  document.body.dispatchEvent(new DragEvent('drop',
    { dataTransfer: carried, bubbles: true, cancelable: true }));
}"""
STILL = "() => !document.querySelector('#panel-quake .files').textContent.startsWith('Reading')"


def synthetic(note: str) -> Record:
    """Return the motion that Python makes of the formula in a note."""
    expression = note.partition("acceleration_m_s2 = ")[2].partition(", dt_s")[0]
    samples = eval(expression, {"np": np, "sum": sum})
    return Record(acceleration_m_s2=samples, dt_s=float(note.rpartition("= ")[2]))


def drop(page: Page, *files: dict[str, object]) -> str:
    """Drop files on the page, and return what its line says of them."""
    page.evaluate(DROP, list(files))
    page.wait_for_timeout(50.0)
    until(page, STILL)
    return page.inner_text(LINE)


def chosen(page: Page) -> str:
    return str(
        page.locator("#panel-quake select").first.evaluate("one => one.selectedOptions[0].text")
    )


@pytest.mark.slow
@pytest.mark.parametrize("model", ["linear", "nonlinear"])
def test_the_motion_of_the_first_view_is_that_of_its_formula(
    explorer: Explorer, model: str
) -> None:
    page = explorer.open({**QUAKE, "model": model, "scale": 1.07})
    note = page.locator("#panel-quake select").first.get_attribute("title")
    assert note is not None
    assert "not a record" in note
    equations = Linear() if model == "linear" else Nonlinear()
    block = Block.rectangle(width=0.5, height=2.0, restitution=0.8)
    run = simulate(block, synthetic(note).scaled(1.07), model=equations)
    shown = values(page, "#panel-quake")
    assert float(shown["quake-peak"]) == run.peak
    assert shown["quake-status"] == run.status.label
    assert int(shown["quake-impacts"]) == len(run.impacts)


@pytest.mark.slow
def test_a_record_that_python_puts_in_is_shown_first(explorer: Explorer, tmp_path: Path) -> None:
    time = np.arange(0.0, 2.0, 0.005)
    pulse = Record(
        acceleration_m_s2=4.0 * np.sin(2.0 * math.pi * time), dt_s=0.005, name="</script><b>pulse"
    )
    explorer.file = write_explorer(tmp_path / "page.html", records=[pulse])
    page = explorer.open("#")
    assert chosen(page) == pulse.name
    block = Block.rectangle(width=0.5, height=2.0, restitution=0.8)
    assert float(values(page, "#panel-quake")["quake-peak"]) == simulate(block, pulse).peak


@pytest.mark.slow
def test_files_that_are_dropped_are_those_that_python_reads(
    explorer: Explorer, tmp_path: Path
) -> None:
    page = explorer.open(QUAKE)
    block = Block.rectangle(width=0.5, height=2.0, restitution=0.8)
    for name in ("crlf", "decimal comma", "blanks", "AT2 run together"):
        text = GOOD[name]
        assert isinstance(text, str)
        drop(page, {"name": f"{name}.csv", "text": text})
        assert chosen(page) == f"{name}.csv"
        path = tmp_path / f"{name}.csv"
        path.write_bytes(text.encode())
        run = simulate(block, read_record(path), model=Nonlinear())
        assert float(values(page, "#panel-quake")["quake-peak"]) == run.peak


@pytest.mark.slow
def test_a_file_is_opened_and_its_unit_asked_for(explorer: Explorer) -> None:
    page = explorer.open(QUAKE)
    rows = "".join(f"{0.02 * k:.2f},{math.sin(0.2 * k):.4f}\n" for k in range(200))
    page.locator("#panel-quake input[type=file]").set_input_files(
        {"name": "shake.csv", "mimeType": "text/csv", "buffer": rows.encode()}
    )
    unit = page.get_by_label("unit of the accelerations")
    unit.wait_for(state="visible")
    assert "does not state the unit" in page.inner_text(LINE)
    unit.select_option("g")
    until(page, "() => document.querySelector('#panel-quake select').options.length === 2")
    assert chosen(page) == "shake.csv"
    assert not unit.is_visible()


@pytest.mark.slow
def test_bad_files_change_nothing_but_a_line(explorer: Explorer) -> None:
    page = explorer.open(QUAKE)
    before = values(page, "#panel-quake")
    for name, text in BAD.items():
        said = drop(page, {"name": "bad.csv", "text": text if isinstance(text, str) else "\0\1\2"})
        assert said.startswith("bad.csv: "), name
    assert drop(page, {"name": "large.csv", "size": 100_000_000}).startswith("large.csv: 100 MB")
    assert values(page, "#panel-quake") == before
    assert page.locator("#panel-quake select").first.locator("option").count() == 1


@pytest.mark.slow
def test_hostile_names_do_nothing(explorer: Explorer) -> None:
    page = explorer.open(QUAKE)
    elements = page.evaluate("document.querySelectorAll('img, script').length")
    for name in NAMES:
        if name.isprintable() or "\u202e" in name:
            drop(page, {"name": name, "text": "time (s),acc (g)\n0,0\n0.02,0.6\n0.04,0\n"})
            drop(page, {"name": name, "text": "nothing"})
    drawn(page)
    assert page.evaluate("document.querySelectorAll('img, script').length") == elements
    assert page.evaluate("document.documentElement.scrollWidth") <= 1440
    assert "\u202e" not in page.inner_text("#panel-quake")


@pytest.mark.slow
def test_dragging_over_the_verdict_sets_the_scale(explorer: Explorer) -> None:
    page = explorer.open(QUAKE)
    box = page.locator("#panel-verdict canvas").bounding_box()
    assert box is not None
    y = box["y"] + 60.0
    page.mouse.move(box["x"] + 0.3 * box["width"], y)
    page.mouse.down()
    page.mouse.move(box["x"] + 0.6 * box["width"], y, steps=10)
    page.mouse.up()
    drawn(page)
    assert 1.4 < float(link(page)["scale"]) < 2.2
    page.locator("#panel-verdict canvas").press("ArrowLeft")
    drawn(page)
    page.go_back()
    drawn(page)
    assert 1.4 < float(link(page)["scale"]) < 2.2


@pytest.mark.slow
def test_dragging_over_the_spectrum_sets_the_size(explorer: Explorer) -> None:
    page = explorer.open(QUAKE)
    box = page.locator("#panel-spectrum canvas").bounding_box()
    assert box is not None
    page.mouse.click(box["x"] + 0.8 * box["width"], box["y"] + 60.0)
    drawn(page)
    found = link(page)
    assert float(found["h"]) > 4.0
    assert float(found["b"]) / float(found["h"]) == pytest.approx(0.25, rel=1e-4)
