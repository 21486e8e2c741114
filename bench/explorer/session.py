"""The page in Chromium, timed from inside: what a frame takes, and what a hand waits for."""

import shutil
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from playwright.sync_api import Browser, Page, sync_playwright

PROGRAMS = ("chromium", "chromium-browser", "google-chrome")
FLAGS = ["--no-sandbox", "--disable-gpu"]
SIZE = {"width": 1280, "height": 800}
CLOCKS = """
  // How long each callback of a frame takes; when canvases are drawn; what workers are asked.
  window.frames_ = [];
  window.long_ = [];
  window.paints_ = {};
  window.jobs_ = new Map();
  const { clearRect, fillText } = CanvasRenderingContext2D.prototype;
  CanvasRenderingContext2D.prototype.clearRect = function (...given) {
    (window.paints_[this.canvas.id] ??= []).push(performance.now());
    clearRect.apply(this, given);
  };
  CanvasRenderingContext2D.prototype.fillText = function (...given) {
    fillText.apply(this, given);
    const all = window.paints_[this.canvas.id];
    if (all) all[all.length - 1] = performance.now(); // a picture ends with its last word
  };
  const PlainWorker = window.Worker;
  window.Worker = class extends PlainWorker {
    constructor(address) {
      super(address);
      this.addEventListener('message', ({ data }) => {
        const asked = window.jobs_.get(data.id);
        if (asked) asked.answered = performance.now();
      });
    }
    postMessage(message) {
      const { id, job, args } = message;
      if (id) window.jobs_.set(id, { id, job, cells: args.x?.length ?? 0 });
      super.postMessage(message);
    }
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
LANDING, SHAKE, PUSH = "", "#v=2&at=lab", "#v=2&at=lab&kind=push"
"""Ends of the page's address."""
STAGE, BLOCK, MAP = "stage", "bench-stage", "bench-picture"
"""Canvases: the landing's, and the laboratory's two."""
FIRST_PICTURE = """names => {
  const all = names.map(name => window.paints_[name]?.[0]);
  return document.documentElement.dataset.ready && all.every(Boolean) ? Math.max(...all) : null;
}"""
DRAG = """async ([name, events]) => {
  const canvas = document.getElementById(name);
  const { left, top, width, height } = canvas.getBoundingClientRect();
  const send = (type, x, y) => canvas.dispatchEvent(new PointerEvent(type, {
    pointerId: 1, pointerType: 'mouse', bubbles: true, cancelable: true, isPrimary: true,
    buttons: 1, clientX: left + x * width, clientY: top + y * height }));
  const frame = () => new Promise(window.plainFrame);
  const work = [];
  send('pointerdown', 0.3, 0.4);
  for (let k = 0; k < events; k += 1) {
    await frame();
    const count = window.frames_.length, began = performance.now();
    send('pointermove', 0.3 + 0.4 * k / events, 0.4 + 0.2 * Math.sin(12 * k / events));
    const handled = performance.now() - began;
    await frame();
    work.push(window.frames_.slice(count).reduce(
      (sum, { began: from, ended }) => sum + ended - from, handled));
  }
  send('pointerup', 0.7, 0.4);
  return work;
}"""
"""What handler and frame take together [ms], event by event."""
MOVED = """async ([name, times]) => {
  const canvas = document.getElementById(name), pen = canvas.getContext('2d');
  const { left, top, width, height } = canvas.getBoundingClientRect();
  const send = (type, x) => canvas.dispatchEvent(new PointerEvent(type, {
    pointerId: 1, pointerType: 'mouse', bubbles: true, cancelable: true, isPrimary: true,
    buttons: 1, clientX: x, clientY: top + height - 44 }));
  const ticks = () => pen.getImageData(0, Math.round(canvas.height * (1 - 108 / height)),
    canvas.width, 1).data.join();
  const frame = () => new Promise(window.plainFrame);
  const middle = left + 0.15 * width, waited = [];
  send('pointerdown', middle);
  for (let k = 0; k < times; k += 1) {
    await new Promise(done => setTimeout(done, 1200)); // the ground has come to rest
    await frame();
    const before = ticks(), began = performance.now();
    send('pointermove', middle + (k % 2 ? 0 : 60));
    let count = 0;
    do { await frame(); count += 1; } while (ticks() === before && count < 60);
    waited.push({ frames: count, time: performance.now() - began });
  }
  send('pointerup', middle);
  return waited;
}"""
"""How many frames, and how long [ms], until resting ground has followed the hand."""
FIRST_MAP = """last => {
  const asked = [...window.jobs_.values()].filter(({ id, job }) => id > last
    && job === 'shakenCells');
  let cells = 0;
  const coarse = asked.filter(each => (cells += each.cells) <= 16 * 12);
  if (cells < 16 * 12 || !coarse.every(({ answered }) => answered)) return null;
  const known = Math.max(...coarse.map(({ answered }) => answered));
  return window.paints_['bench-picture'].find(time => time > known) ?? null;
}"""
"""When the first cells of a map are drawn that was asked after a job."""
COARSE = """async address => {
  const last = Math.max(0, ...window.jobs_.keys()), began = performance.now();
  const later = time => new Promise(done => setTimeout(done, time));
  location.hash = address;
  let found = null;
  while (found === null && performance.now() - began < 10000) {
    await later(1);
    found = (FIRST_MAP)(last);
  }
  while ([...window.jobs_.values()].some(({ answered }) => !answered)
    && performance.now() - began < 20000) await later(50);
  await later(200);
  return found - began;
}""".replace("FIRST_MAP", FIRST_MAP)
"""How long it takes from another block to the first map of it [ms]."""


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


def opened(browser: Browser, file: Path, where: str, **how: Any) -> tuple[Page, float]:
    """Return the page in a new context, and after how many milliseconds it has its picture."""
    page = browser.new_context(viewport=SIZE, **how).new_page()
    page.add_init_script(CLOCKS)
    page.goto(file.as_uri() + where)
    pictures = [STAGE] if where == LANDING else [BLOCK, MAP]
    while (first := page.evaluate(FIRST_PICTURE, pictures)) is None:
        page.wait_for_timeout(10.0)
    return page, first
