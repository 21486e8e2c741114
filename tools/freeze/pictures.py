"""Pictures as text: words, and hashes of forms and places; on any machine the same."""

import base64
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
PIXELS = re.compile(r"data:image/png;base64,([^\"]*)")
NUMBER = re.compile(r"(?<![\w#.])-?\d+(?:\.\d+)?(?![\w.])")
STEPS, SHIFT = 50.0, 0.37
"""Steps of a point, and where they begin: no place that a design gives lies between two."""


def drawn(picture: str) -> str:
    """Return what an SVG of Matplotlib shows.

    Numbers are rounded: last digits differ with the instructions of a processor.
    """
    body = PIXELS.sub(_pixels, NAME.sub("", picture.partition(HEAD)[2]))
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
