"""The explorer's page: its parts, the kernels and the first view in one HTML file."""

import base64
import gzip
import hashlib
import html
import json
import re
from collections.abc import Mapping, Sequence
from typing import Any

from rocksteady import __version__
from rocksteady.explorer._palette import page_theme, style_variables
from rocksteady.explorer._program import PARTS, program
from rocksteady.explorer._still import still_picture

SHEETS = ("base.css", "style.css", "story.css", "bench.css")
_SLOT = re.compile(r"\{\{(\w+)\}\}")
_COMMENT = re.compile(r"/\*.*?\*/", re.DOTALL)
_SPACE = re.compile(r"\s*([{};,])\s*|\s+")


def document(
    *, state: Mapping[str, str], motions: Sequence[Mapping[str, object]], module: bytes
) -> str:
    """Return the page.

    Parameters
    ----------
    state
        The first view, by the keys of the page's link.
    motions
        Ground motions put in, as `rocksteady.explorer._motions` writes them.
    module
        The kernels as WebAssembly.

    Returns
    -------
    str
        HTML with all that it needs inside.  Its policy lets it run its own script and nothing else:
        it asks no server for anything.
    """
    code = program()
    style = _style(*SHEETS)
    slots = {
        "csp": html.escape(_policy(code, style)),
        "style": style,
        "still": still_picture(),
        "version": html.escape(__version__),
        "palette": _block(page_theme()),
        "view": _block(dict(state)),
        "motions": _block([dict(motion) for motion in motions]),
        "kernels": _packed(module),
        "program": code,
    }
    template = (PARTS / "index.html").read_text(encoding="utf-8")
    return _SLOT.sub(lambda slot: slots[slot[1]], template)


def scene_document(scene: str, *, module: bytes) -> str:
    """Return a scene of the page alone, with the kernels.

    Parameters
    ----------
    scene
        One of `SCENES`.
    module
        The kernels as WebAssembly.

    Returns
    -------
    str
        HTML under the policy of the page.
    """
    code = program(scene)
    words = (PARTS / "index.html").read_text(encoding="utf-8")
    section = re.search(rf'<section[^>]* data-at="{scene}".*?</section>', words, re.DOTALL)
    assert section is not None
    (heading,) = re.findall(r"<h[12][^>]*>(.*?)</h[12]>", section[0])
    style = _style("base.css", "story.css")
    slots = {
        "csp": html.escape(_policy(code, style)),
        "style": style,
        "title": heading,
        "scene": section[0],
        "palette": _block(page_theme()),
        "view": _block({"at": scene}),
        "kernels": _packed(module),
        "program": code,
    }
    template = (PARTS / "embed.html").read_text(encoding="utf-8")
    return _SLOT.sub(lambda slot: slots[slot[1]], template)


def _style(*names: str) -> str:
    """Return the colours of both themes and some sheets, without comments and needless spaces."""
    sheets = [(PARTS / name).read_text(encoding="utf-8") for name in names]
    text = _COMMENT.sub("", style_variables() + "".join(sheets))
    return _SPACE.sub(lambda space: space[1] or " ", text)


def _policy(code: str, style: str) -> str:
    """Return the policy of a page that runs its own script and style, and asks no server."""
    return (
        f"default-src 'none'; script-src {_hash(code)} 'wasm-unsafe-eval'; "
        f"style-src {_hash(style)}; worker-src blob:; img-src data: blob:; "
        "base-uri 'none'; form-action 'none'"
    )


def _packed(module: bytes) -> str:
    """Return a module as base64 of gzip."""
    return base64.b64encode(gzip.compress(module, 9, mtime=0)).decode("ascii")


def _hash(text: str) -> str:
    """Return the source expression by which a policy allows an inline text."""
    digest = hashlib.sha256(text.encode("utf-8")).digest()
    return f"'sha256-{base64.b64encode(digest).decode('ascii')}'"


def _block(value: Any) -> str:
    """Return JSON that cannot end the element in which it stands."""
    text = json.dumps(value, ensure_ascii=True, allow_nan=False, separators=(",", ":"))
    return text.replace("<", "\\u003c").replace(">", "\\u003e").replace("&", "\\u0026")
