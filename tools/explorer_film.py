"""Film the explorer being dragged: docs/images/explorer.gif, the picture of the README.

``python -m tools.explorer_film [FILE]`` opens the page in Chromium, drags the point of the map from
region to region with a pointer that is drawn in, and puts screenshots together. A run takes about a
minute; each picture is taken when the page has drawn, so that the film does not depend on the speed
of the machine.
"""

import io
import math
import shutil
import sys
import tempfile
from itertools import pairwise
from pathlib import Path
from typing import NamedTuple

from PIL import Image, ImageDraw
from playwright.sync_api import Page, sync_playwright

from rocksteady import write_explorer
from rocksteady.show.style.tokens import LIGHT

ROOT = Path(__file__).parents[1]
TARGET = ROOT / "docs" / "images" / "explorer.gif"
PROGRAMS = ("chromium", "chromium-browser", "google-chrome")
SIZE = (1200, 900)
"""Of the page [px]."""
WIDTH = 800
"""Of the film [px]."""
FRAME_MS = 100
MOST_BYTES = 2_000_000
COLOURS = 128
RARE = (LIGHT.unsymmetric, LIGHT.aperiodic, LIGHT.impact, LIGHT.motion, LIGHT.base)
"""Colours that cover little of a picture, and are kept all the same."""
ARROW = [(0, 0), (0, 17), (4, 13), (7, 20), (10, 19), (7, 12), (12, 12)]
"""The pointer [px]."""
CLOCK = """
  // Time passes only as the film wants: a frame is as long as the film's.
  let now = 0;
  const waiting = [];
  performance.now = () => now;
  window.requestAnimationFrame = callback => waiting.push(callback);
  window.pass = milliseconds => {
    now += milliseconds;
    for (const callback of waiting.splice(0)) callback(now);
  };
"""
PLACE = """() => {
  const { left, top, width, height } =
    document.querySelector("[data-panel='map'] canvas").getBoundingClientRect();
  return [left, top, width, height];
}"""
SHOWN = (
    """() => ['W', 'A'].map(name => Number(document.getElementById(`in-${name}`).dataset.value))"""
)


class Stop(NamedTuple):
    """A place of the map to which the point is dragged."""

    ratio: float
    amplitude: float
    frames: int
    """Of the way there."""
    rest: int
    """Frames spent there."""


PATH = [
    Stop(3.0, 2.0, 0, 8),
    Stop(2.0, 0.8, 12, 10),  # rest and the harmonic coexist
    Stop(6.0, 2.0, 14, 12),  # the harmonic and a subharmonic
    Stop(1.9, 2.0, 14, 8),  # unsymmetric
    Stop(2.0, 4.6, 10, 14),  # overturned
]


class Hand:
    """The pointer over the map."""

    def __init__(self, page: Page) -> None:
        self.page = page
        self.at = (0.0, 0.0)
        # Two clicks tell where points of the map lie, so that no margin is known here.
        known = []
        for part in (0.35, 0.65):
            page.mouse.click(*self.pixel(part, part))
            settle(page, 600)
            known.append((part, *page.evaluate(SHOWN)))
        (x0, w0, a0), (x1, w1, a1) = known
        self.across = (x1 - x0) / (w1 - w0), x0, w0
        self.down = (x1 - x0) / (a1 - a0), x0, a0

    def pixel(self, across: float, down: float) -> tuple[float, float]:
        """Return where a place of the map is, in parts of its picture."""
        left, top, width, height = self.page.evaluate(PLACE)
        return left + across * width, top + down * height

    def move(self, ratio: float, amplitude: float) -> None:
        """Go to a point of the map."""
        (by, x, w), (down, y, a) = self.across, self.down
        self.at = self.pixel(x + by * (ratio - w), y + down * (amplitude - a))
        self.page.mouse.move(*self.at)


def settle(page: Page, milliseconds: int) -> None:
    """Let the page's workers compute for some time, and draw what they found."""
    for _ in range(max(1, milliseconds // 50)):
        page.wait_for_timeout(50.0)
        page.evaluate("window.pass(0)")


def picture(page: Page, hand: Hand, *, held: bool) -> Image.Image:
    """Return the page as it is seen, with the pointer."""
    seen = Image.open(io.BytesIO(page.screenshot())).convert("RGB")
    pen = ImageDraw.Draw(seen)
    x, y = hand.at
    if held:
        pen.ellipse((x - 14, y - 14, x + 14, y + 14), outline="#1273b8", width=2)
    pen.polygon([(x + dx, y + dy) for dx, dy in ARROW], fill="white", outline="black")
    size = WIDTH, round(seen.height * WIDTH / seen.width)
    return seen.resize(size, Image.Resampling.LANCZOS)


def film(page: Page) -> list[Image.Image]:
    """Return the pictures of a drag along the path."""
    hand = Hand(page)
    hand.move(PATH[0].ratio, PATH[0].amplitude)
    page.mouse.down()
    frames = []

    def shoot(wait: int) -> None:
        page.evaluate(f"window.pass({FRAME_MS})")
        settle(page, wait)
        frames.append(picture(page, hand, held=True))

    for _ in range(PATH[0].rest):
        shoot(100)
    for before, after in pairwise(PATH):
        for k in range(1, after.frames + 1):
            part = 0.5 - 0.5 * math.cos(math.pi * k / after.frames)
            hand.move(
                before.ratio + part * (after.ratio - before.ratio),
                before.amplitude + part * (after.amplitude - before.amplitude),
            )
            shoot(50)
        for _ in range(after.rest):
            shoot(150)
    page.mouse.up()
    return frames


def save(frames: list[Image.Image], target: Path) -> None:
    """Write the film with one palette for all its frames.

    Raises
    ------
    SystemExit
        If it is too large for a page.
    """
    strip = Image.new("RGB", (WIDTH, 4 * frames[0].height + 20 * len(RARE)))
    for k in range(4):
        strip.paste(frames[k * (len(frames) - 1) // 3], (0, k * frames[0].height))
    for k, colour in enumerate(RARE):
        top = 4 * frames[0].height + 20 * k
        strip.paste(colour, (0, top, WIDTH, top + 20))
    chosen = strip.quantize(COLOURS, dither=Image.Dither.NONE)
    flat = [frame.quantize(palette=chosen, dither=Image.Dither.NONE) for frame in frames]
    flat[0].save(
        target, save_all=True, append_images=flat[1:], duration=FRAME_MS, loop=0, optimize=True
    )
    size = target.stat().st_size
    print(f"{target}: {len(frames)} frames, {size / 1e6:.2f} MB")
    if size > MOST_BYTES:
        raise SystemExit(f"more than {MOST_BYTES / 1e6:.0f} MB: take fewer frames or colours")


def main(target: Path) -> None:
    """Film the page.

    Raises
    ------
    SystemExit
        If no Chromium is installed.
    """
    program = next(filter(None, map(shutil.which, PROGRAMS)), None)
    if program is None:
        raise SystemExit("no Chromium is installed")
    with tempfile.TemporaryDirectory() as folder, sync_playwright() as playwright:
        address = write_explorer(Path(folder) / "explorer.html").as_uri() + "#v=1&at=lab"
        browser = playwright.chromium.launch(executable_path=program, args=["--no-sandbox"])
        page = browser.new_page(viewport={"width": SIZE[0], "height": SIZE[1]})
        page.add_init_script(CLOCK)
        page.goto(address)
        page.locator("[data-panel='map']").wait_for()
        settle(page, 6000)
        frames = film(page)
        browser.close()
    save(frames, target)


if __name__ == "__main__":
    main(Path(sys.argv[1]) if len(sys.argv) > 1 else TARGET)
