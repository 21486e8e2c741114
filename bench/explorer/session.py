"""The page in Chromium, timed from inside: what a frame takes, and what a drag waits for."""

import shutil
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from playwright.sync_api import Browser, Page, sync_playwright

PROGRAMS = ("chromium", "chromium-browser", "google-chrome")
FLAGS = ["--no-sandbox", "--disable-gpu"]
SIZE = {"width": 1440, "height": 900}
CLOCKS = """
  // How long each callback of a frame takes, and when it ends.
  window.frames_ = [];
  window.long_ = [];
  document.addEventListener('settled', () => { window.settled_ ??= performance.now(); });
  const fill = CanvasRenderingContext2D.prototype.fillText;
  CanvasRenderingContext2D.prototype.fillText = function (...given) {
    if (this.canvas.id === 'stage') window.block_ ??= performance.now();
    fill.apply(this, given);
  };
  const plain = window.requestAnimationFrame.bind(window);
  window.plainFrame = plain;
  window.requestAnimationFrame = callback => plain(moment => {
    const began = performance.now();
    callback(moment);
    window.frames_.push({ began, ended: performance.now() });
  });
  new PerformanceObserver(list => window.long_.push(...list.getEntries().map(
    ({ startTime, duration }) => ({ startTime, duration })))).observe(
      { type: 'longtask', buffered: true });
"""
LABORATORY, LANDING = "#v=1&at=lab", ""
"""Ends of the page's address."""
FIRST_PICTURE = {
    LABORATORY: "() => window.settled_ ?? null",
    LANDING: "() => document.documentElement.dataset.ready && (window.block_ ?? null)",
}
"""When the first picture is there, by what is opened."""
MAP, STAGE = "[data-panel='map'] canvas", "#stage"
"""What is dragged."""
DRAG = """async ([name, events]) => {
  const canvas = document.querySelector(name);
  const { left, top, width, height } = canvas.getBoundingClientRect();
  const send = (type, x, y) => canvas.dispatchEvent(new PointerEvent(type, {
    pointerId: 1, pointerType: 'mouse', bubbles: true, cancelable: true, isPrimary: true,
    buttons: 1, clientX: left + x * width, clientY: top + y * height }));
  const frame = () => new Promise(window.plainFrame);
  const work = [], next = [];
  send('pointerdown', 0.3, 0.4);
  for (let k = 0; k < events; k += 1) {
    await frame();
    const count = window.frames_.length, began = performance.now();
    send('pointermove', 0.3 + 0.4 * k / events, 0.4 + 0.2 * Math.sin(12 * k / events));
    const handled = performance.now() - began;
    await frame();
    next.push(performance.now() - began);
    const drawn = window.frames_.slice(count).reduce(
      (sum, { began: from, ended }) => sum + ended - from, 0);
    work.push(handled + drawn);
  }
  send('pointerup', 0.7, 0.4);
  return { work, next };
}"""
REFINED = """async () => {
  const note = document.querySelector("[data-panel='map'] .note");
  const canvas = document.querySelector("[data-panel='map'] canvas");
  const found = {}, began = performance.now();
  canvas.dispatchEvent(new KeyboardEvent('keydown', { key: '+', bubbles: true }));
  let refining = false;
  while (performance.now() - began < 60000) {
    await new Promise(done => setTimeout(done, 1));
    const part = note.textContent.match(/refining (\\d+) %/)?.[1];
    if (part !== undefined) refining = true;
    const cells = note.textContent.match(/^([\\d,]+) cells/)?.[1];
    if (refining && !found.coarse && (Number(part) >= 1 || cells)) {
      found.coarse = performance.now() - began;
    }
    if (refining && cells) {
      found.whole = performance.now() - began;
      found.cells = Number(cells.replaceAll(',', ''));
      return found;
    }
  }
  return found;
}"""
MAP_OF = """async ([side, pieces]) => {
  // The page's own script in workers, as its pool starts them.
  const text = id => document.getElementById(id).textContent;
  const bytes = Uint8Array.from(atob(text('kernels').trim()), letter => letter.charCodeAt(0));
  const plain = new Blob([bytes]).stream().pipeThrough(new DecompressionStream('gzip'));
  const module = await WebAssembly.compile(await new Response(plain).arrayBuffer());
  const url = URL.createObjectURL(new Blob([text('program')], { type: 'text/javascript' }));
  const workers = Array.from({ length: Math.max(2, navigator.hardwareConcurrency) }, () => {
    const worker = new Worker(url);
    worker.postMessage({ module });
    return worker;
  });
  const given = { amplitude: 0, frequencyRatio: 0, restitution: 0.8, nonlinear: false, alpha: 0.2 };
  const axis = (from, to, count) =>
    Float64Array.from({ length: count }, (_, k) => from + (to - from) * k / (count - 1));
  const [ratios, amplitudes] = [axis(0.5, 8, side), axis(0, 6, side)];
  const run = () => new Promise((done, failed) => {
    let next = 0, left = pieces;
    const rows = side / pieces;
    const ask = worker => {
      if (next === pieces) return;
      const args = { given, start: { kind: 'rest' }, ratios, nested: false,
        amplitudes: amplitudes.slice(next * rows, (next + 1) * rows) };
      worker.postMessage({ id: next++, job: 'mapTile', args });
    };
    for (const worker of workers) {
      worker.onmessage = ({ data }) => {
        if (data.fault) failed(new Error(data.fault));
        else if (--left === 0) done();
        else ask(worker);
      };
      ask(worker);
    }
  });
  await run(); // Chromium compiles to its best on the first run
  const times = [];
  for (let k = 0; k < 9; k += 1) {
    const began = performance.now();
    await run();
    times.push(performance.now() - began);
  }
  for (const worker of workers) worker.terminate();
  return times;
}"""


@contextmanager
def chromium() -> Iterator[Browser]:
    """Start Chromium.

    Raises
    ------
    SystemExit
        If there is none.
    """
    program = next(filter(None, map(shutil.which, PROGRAMS)), None)
    if program is None:
        raise SystemExit("no Chromium is installed")
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=program, args=FLAGS)
        yield browser
        browser.close()


def opened(browser: Browser, file: Path, where: str = LABORATORY, **how: Any) -> tuple[Page, float]:
    """Return the page in a new context, and after how many milliseconds it has its picture."""
    page = browser.new_context(viewport=SIZE, **how).new_page()
    page.add_init_script(CLOCKS)
    page.goto(file.as_uri() + where)
    while (first := page.evaluate(FIRST_PICTURE[where])) is None:
        page.wait_for_timeout(10.0)
    return page, first
