"""The pictures that pages show as files: each is drawn on both papers by what its caption names.

`python -m tools.manual.images [NAME ...]` draws those in docs/images again, or some of them.
"""

import re
import shlex
import sys
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np

from rocksteady.cli.app import run
from rocksteady.show.style.tokens import DARK, LIGHT
from tools.manual import gallery, twins

ROOT = gallery.EXAMPLES.parent
IMAGES = ROOT / "docs" / "images"
CAPTIONED = re.compile(
    r"\]\((?:[\w./-]*/)?([\w-]+\.png)\)\n\n(?:(?!\n\n)[\s\S])*?"
    r"Made\s+by\s+`((?:examples/|rocksteady )[^`]+)`"
)
"""A picture, and the script or the command line that its caption names."""
DPI = 180.0


def makers() -> dict[str, str]:
    """Return what makes each picture: a script of examples/, or a command line."""
    pages = [ROOT / "README.md", *sorted((ROOT / "docs").rglob("*.md"))]
    texts = [page.read_text(encoding="utf-8") for page in pages]
    found = [pair for text in texts for pair in CAPTIONED.findall(text)]
    return {picture: " ".join(maker.split()) for picture, maker in found}


def draw(name: str, maker: str, folder: Path) -> None:
    """Draw a picture into a folder on both papers."""
    if maker.startswith("examples/"):
        script = ROOT / maker
        gallery.MEMORY.listen(script.read_text(encoding="utf-8"))
        gallery.draw_on(LIGHT, script, [folder / name])
        with gallery.MEMORY.again():
            gallery.draw_on(DARK, script, [twins.dark_twin(folder / name)])
        gallery.MEMORY.restore()
    else:
        for inks, file in ((LIGHT, folder / name), (DARK, twins.dark_twin(folder / name))):
            with TemporaryDirectory() as place, twins.on_paper(inks, dpi=DPI):
                words = shlex.split(re.sub(r"--plot \S+", f"--plot '{place}/drawn.png'", maker))
                assert run(words[1:]) == 0, maker
                (Path(place) / "drawn.png").rename(file)
    for inks, file in ((LIGHT, folder / name), (DARK, twins.dark_twin(folder / name))):
        make_small(file, inks.page, maker)


def make_small(file: Path, ground: str, source: str) -> None:
    """Rewrite a PNG with 256 colours, of which the ground is transparent."""
    from PIL import Image
    from PIL.PngImagePlugin import PngInfo

    with Image.open(file) as drawn:
        before = {
            name: text
            for name, text in drawn.info.items()
            if isinstance(name, str) and isinstance(text, str)
        }
        sheet = Image.new("RGBA", drawn.size, ground)
        sheet.alpha_composite(drawn.convert("RGBA"))
        shown = sheet.convert("RGB")
    few = shown.quantize(255, method=Image.Quantize.MEDIANCUT, dither=Image.Dither.NONE)
    colour = tuple(int(ground[k : k + 2], 16) for k in (1, 3, 5))
    indices = np.array(few)
    indices[(np.array(shown) == colour).all(axis=2)] = 255
    small = Image.fromarray(indices, mode="P")
    table = (few.getpalette() or [])[: 3 * 255]
    small.putpalette([*table, *[0] * (3 * 255 - len(table)), *colour])
    words = PngInfo()
    for name, text in {**before, "Software": "rocksteady", "Source": source}.items():
        words.add_text(name, text)
    small.save(file, optimize=True, transparency=255, pnginfo=words)


def main(names: list[str], folder: Path = IMAGES) -> None:
    """Draw some of the pictures, or all."""
    folder.mkdir(parents=True, exist_ok=True)
    for name, maker in makers().items():
        if not names or name in names:
            draw(name, maker, folder)


if __name__ == "__main__":
    main(sys.argv[1:])
