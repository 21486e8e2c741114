"""Small pictures of every scene and tab: ``python -m tests.explorer.browser.pictured`` keeps them.

It keeps all sheets, or those that are named.  Each is one size of window and one theme, a picture a
column, so small that fonts of other machines do not show, and large enough that a part which is
missing does.
"""

import io
import sys
import tempfile
from collections.abc import Callable, Collection
from pathlib import Path

from PIL import Image
from playwright.sync_api import Page

from rocksteady import write_explorer
from tests.explorer.browser.watched import Explorer, Watch, chromium

FOLDER = Path(__file__).with_name("pictures")
SIZES = {
    "desktop": (1440, 900), "phone": (390, 844), "laptop": (1280, 800), "wide": (1600, 1000),
}  # fmt: skip
LOOKS = ("light", "dark")
STORY = ("push", "swing", "size", "fall", "fates", "order", "quake")
VIEWS = {
    **{scene: f"#v=1&at={scene}" for scene in STORY},
    **{
        f"lab {tab}": f"#v=1&at=lab&tab={tab}"
        for tab in ("explore", "basins", "pulse", "quake", "design")
    },
}
QUESTIONS = {
    "goes on": "#v=2&at=lab&kind=on",
    "one push": "#v=2&at=lab&kind=push",
    "by hand": "#v=2&at=lab&b=1.1&h=1.3",
    "fallen": "#v=2&at=lab&kind=push&b=0.4&pA=4&pW=2",
    "more": "#v=2&at=lab&kind=on&A=2.5",
    "held": "#v=2&at=lab&tab=start&start=0.7,0",
    "starts": "#v=2&at=lab&tab=start&ground=shaken&model=linear&A=0.5&W=2&start=0.4,0",
    "which block": "#v=2&at=lab&tab=size&kind=push&b=0.6&h=2&pA=2.2&pW=3.6",
}
"""States of the laboratory's questions."""


def _push(page: Page) -> None:
    """Push ground that does not lift the block to and fro."""
    box = page.locator("#bench-stage").bounding_box()
    assert box is not None
    x, y = box["x"] + 0.2 * box["width"], box["y"] + box["height"] - 90.0
    page.mouse.move(x, y)
    page.mouse.down()
    for there in (0.02 * box["width"], -0.02 * box["width"], 0.0):
        page.mouse.move(x + there, y, steps=8)
        page.wait_for_timeout(250.0)
    page.mouse.up()


def _play(page: Page) -> None:
    page.locator("#bench-act").click()


def _turn_over(page: Page) -> None:
    page.locator("#bench-more").click()


ACTS: dict[str, Callable[[Page], None]] = {"by hand": _push, "fallen": _play, "more": _turn_over}
"""What leads to a view from where its address opens."""
SHEETS = {
    **{f"{size}-{look}": (size, look, VIEWS) for size in ("desktop", "phone") for look in LOOKS},
    **{
        f"lab-{size}-{look}": (size, look, QUESTIONS)
        for size, look in (
            ("laptop", "light"), ("laptop", "dark"), ("wide", "light"),
            ("phone", "light"), ("phone", "dark"),
        )
    },
}  # fmt: skip
"""Size, theme and views of each sheet."""
HEIGHT = 64
"""Of a picture [px]."""
PAUSE, PAUSES = 500.0, 40
"""Milliseconds between two looks at a page that may still be computing, and how many."""


def sheet(explorer: Explorer, name: str, views: Collection[str]) -> Image.Image:
    """Return the pictures of some views of a sheet, side by side."""
    size, look, addresses = SHEETS[name]
    width, height = SIZES[size]
    small = (round(width * HEIGHT / height), HEIGHT)
    made = Image.new("RGB", (small[0] * len(views), HEIGHT))
    for column, view in enumerate(views):
        page = explorer.open(addresses[view], (width, height), color_scheme=look)
        if act := ACTS.get(view):
            act(page)
        shot = settled(page).convert("RGB").resize(small, Image.Resampling.BOX)
        made.paste(shot, (column * small[0], 0))
        page.context.close()
    return made


def settled(page: Page) -> Image.Image:
    """Return the picture of a page that has stopped to change."""
    page.wait_for_timeout(2.0 * PAUSE)
    before = b""
    for _ in range(PAUSES):
        now = page.screenshot()
        if now == before:
            break
        before = now
        page.wait_for_timeout(PAUSE)
    return Image.open(io.BytesIO(before))


def main(names: Collection[str]) -> None:
    """Keep some sheets, or all."""
    FOLDER.mkdir(exist_ok=True)
    with tempfile.TemporaryDirectory() as folder, chromium() as browser:
        file = write_explorer(Path(folder, "explorer.html"))
        for name in names or SHEETS:
            explorer = Explorer(browser, file, Watch())
            sheet(explorer, name, SHEETS[name][2]).save(FOLDER / f"{name}.png", optimize=True)


if __name__ == "__main__":
    main(sys.argv[1:])
