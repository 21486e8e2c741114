"""Pictures and pages as text: words, and hashes of the rest; on any machine the same."""

import base64
import html
import io
import math
import re

import numpy as np
from PIL import Image

from tools.freeze.records import digest

HEAD = "</metadata>"
WORDS = re.compile(r"<!-- (.*?) -->", re.DOTALL)
NAME = re.compile(r'(?<=[#"])[a-z]+[0-9a-f]{10,}(?=[")])')
"""Name of a path, a hash of all digits of its numbers."""
PICTURE = re.compile(r"data:image/svg\+xml;base64,([^\"')]*)")
TAGS = re.compile(r"<(style|script)\b.*?</\1>|<[^>]*>", re.DOTALL)
MADE = re.compile(r"rocksteady \d[^<]*")
"""Versions of what has made a page."""
PIXELS = re.compile(r"data:image/png;base64,([^\"]*)")
NUMBER = re.compile(r"(?<![\w#.])-?\d+(?:\.\d+)?(?![\w.])")
STEPS, SHIFT = 50.0, 0.37
"""Steps of a point, and where they begin: no place that a design gives lies between two."""


def drawn(picture: str) -> str:
    """Return what an SVG of Matplotlib shows.

    Numbers are rounded: last digits differ with the instructions of a processor.
    """
    body = PIXELS.sub(_pixels, NAME.sub("", picture.rpartition(HEAD)[2]))
    words = " | ".join(" ".join(word.split()) for word in WORDS.findall(body))
    body = WORDS.sub("", body)
    places = [str(math.floor(STEPS * float(number) + SHIFT)) for number in NUMBER.findall(body)]
    forms = NUMBER.sub("", body)
    return "\n".join(
        (
            f"words: {words}",
            f"forms: {len(forms)} characters, {digest(forms)}",
            f"places: {len(places)}, {digest(' '.join(places))}",
        )
    )


def _pixels(data: re.Match[str]) -> str:
    with Image.open(io.BytesIO(base64.b64decode(data[1]))) as image:
        return f"{image.size} {digest(np.asarray(image.convert('RGBA')).tobytes())}"


def written(page: str) -> str:
    """Return what a page in HTML shows, its pictures as in `drawn`."""
    body = MADE.sub("", PICTURE.sub(_picture, page))
    words = " ".join(html.unescape(TAGS.sub(" ", body)).split())
    return f"words: {words}\nforms: {len(body)} characters, {digest(body)}"


def _picture(data: re.Match[str]) -> str:
    return drawn(base64.b64decode(data[1]).decode())
