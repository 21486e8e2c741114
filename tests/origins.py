"""What the file of a picture says of its origin."""

import re
from io import BytesIO
from xml.etree import ElementTree as ET

from PIL import Image

DUBLIN_CORE = "{http://purl.org/dc/elements/1.1/}"


def origin_of(data: bytes, kind: str) -> tuple[str | None, str | None]:
    """Return the program and the command that a picture names."""
    if kind == "png":
        texts = Image.open(BytesIO(data)).text  # type: ignore[attr-defined]
        return texts.get("Software"), texts.get("Source")
    if kind == "pdf":
        return _entry(data, b"Creator"), _entry(data, b"Subject")
    root = ET.fromstring(data)
    creator = root.find(f".//{DUBLIN_CORE}creator")
    agent = None if creator is None else "".join(creator.itertext()).strip()
    return agent, root.findtext(f".//{DUBLIN_CORE}source")


def _entry(data: bytes, name: bytes) -> str | None:
    """Return a text of the information of a PDF."""
    found = re.search(rb"/" + name + rb" \(((?:[^()\\]|\\.)*)\)", data, re.DOTALL)
    if found is None:
        return None
    text = re.sub(
        rb"\\(.)", lambda each: {b"n": b"\n", b"r": b"\r"}.get(each[1], each[1]), found[1]
    )
    return text.decode("utf-16" if text.startswith(b"\xfe\xff") else "ascii")
