"""Small pictures of every scene and tab: ``python -m tests.explorer.browser.pictured`` keeps them.

Each file is a sheet of one size of window and one theme, a picture a column, so small that fonts of
other machines do not show, and large enough that a part which is missing does.
"""

import io
import tempfile
from collections.abc import Collection
from pathlib import Path

from PIL import Image
from playwright.sync_api import Page

from rocksteady import write_explorer
from tests.explorer.browser.watched import Explorer, Watch, chromium

FOLDER = Path(__file__).with_name("pictures")
SIZES = {"desktop": (1440, 900), "phone": (390, 844)}
LOOKS = ("light", "dark")
STORY = ("push", "swing", "size", "fall", "fates", "order", "quake")
VIEWS = {
    **{scene: f"#v=1&at={scene}" for scene in STORY},
    **{
        f"lab {tab}": f"#v=1&at=lab&tab={tab}"
        for tab in ("explore", "basins", "pulse", "quake", "design")
    },
}
HEIGHT = 64
"""Of a picture [px]."""
PAUSE, PAUSES = 500.0, 40
"""Milliseconds between two looks at a page that may still be computing, and how many."""


def sheet(explorer: Explorer, size: str, look: str, views: Collection[str]) -> Image.Image:
    """Return the pictures of some views, side by side."""
    width, height = SIZES[size]
    small = (round(width * HEIGHT / height), HEIGHT)
    made = Image.new("RGB", (small[0] * len(views), HEIGHT))
    for column, view in enumerate(views):
        page = explorer.open(VIEWS[view], (width, height), color_scheme=look)
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


def main() -> None:
    """Keep the sheets."""
    FOLDER.mkdir(exist_ok=True)
    with tempfile.TemporaryDirectory() as folder, chromium() as browser:
        file = write_explorer(Path(folder, "explorer.html"))
        for size in SIZES:
            for look in LOOKS:
                explorer = Explorer(browser, file, Watch())
                sheet(explorer, size, look, VIEWS).save(
                    FOLDER / f"{size}-{look}.png", optimize=True
                )


if __name__ == "__main__":
    main()
