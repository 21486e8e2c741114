"""Film the explorer as it opens and is pushed: docs/images/explorer.gif, the picture of the README.

``python -m tools.explorer_film [FILE]`` opens the page in Chromium, drags the ground with a pointer
that is drawn in, and puts screenshots together. The page's clock is the film's: the film does not
depend on the speed of the machine.
"""

import io
import math
import shutil
import sys
import tempfile
from collections.abc import Iterator
from pathlib import Path

from PIL import Image, ImageDraw
from playwright.sync_api import Page, sync_playwright

from rocksteady import write_explorer

ROOT = Path(__file__).parents[1]
TARGET = ROOT / "docs" / "images" / "explorer.gif"
PROGRAMS = ("chromium", "chromium-browser", "google-chrome")
SIZE = (1000, 700)
"""Of the page [px]."""
WIDTH = 800
"""Of the film [px]."""
FRAME_MS = 60
STEP_MS = 10
"""Of the page's clock."""
COLOURS = 48
PUSHES = ((0.0, 5), (130.0, 3), (130.0, 22), (-150.0, 3), (-150.0, 40))
"""Where the hand goes from the middle [px], and in how many frames."""
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


def places() -> Iterator[float]:
    """Yield where the hand is in each frame, from the middle [px]."""
    before = 0.0
    for after, frames in PUSHES:
        for k in range(1, frames + 1):
            part = 0.5 - 0.5 * math.cos(math.pi * k / frames)
            yield before + part * (after - before)
        before = after


def film(page: Page) -> list[Image.Image]:
    """Return the pictures of the page while its ground is dragged."""
    x, y = SIZE[0] / 2, 0.76 * SIZE[1]
    page.mouse.move(x, y)
    page.mouse.down()
    frames = []
    for place in places():
        page.mouse.move(x + place, y)
        for _ in range(FRAME_MS // STEP_MS):
            page.evaluate(f"window.pass({STEP_MS})")
        seen = Image.open(io.BytesIO(page.screenshot())).convert("RGB")
        arrow = [(x + place + dx, y + dy) for dx, dy in ARROW]
        ImageDraw.Draw(seen).polygon(arrow, fill="white", outline="black")
        size = WIDTH, round(seen.height * WIDTH / seen.width)
        frames.append(seen.resize(size, Image.Resampling.LANCZOS))
    page.mouse.up()
    return frames


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
        address = write_explorer(Path(folder) / "explorer.html").as_uri()
        browser = playwright.chromium.launch(executable_path=program, args=["--no-sandbox"])
        page = browser.new_page(viewport={"width": SIZE[0], "height": SIZE[1]})
        page.add_init_script(CLOCK)
        page.goto(address)
        for _ in range(60):
            page.wait_for_timeout(20.0)
            page.evaluate("window.pass(20)")
        frames = film(page)
        browser.close()
    palette = frames[len(frames) // 2].quantize(COLOURS, dither=Image.Dither.NONE)
    flat = [frame.quantize(palette=palette, dither=Image.Dither.NONE) for frame in frames]
    flat[0].save(
        target, save_all=True, append_images=flat[1:], duration=FRAME_MS, loop=0, optimize=True
    )
    print(f"{target}: {len(frames)} frames, {target.stat().st_size / 1e6:.2f} MB")


if __name__ == "__main__":
    main(Path(sys.argv[1]) if len(sys.argv) > 1 else TARGET)
