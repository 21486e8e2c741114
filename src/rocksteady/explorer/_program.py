"""The page's scripts: each bundled into one when the package is built."""

import hashlib
import json
from pathlib import Path

from rocksteady.errors import MissingKernelsError, Words
from rocksteady.kernels.machine_code.sources import libraries_folder

PARTS = Path(__file__).parent / "parts"
SCENES = ("push", "swing", "size", "fall", "fates", "order", "quake")
"""Places of the page's story, each of which has a script of its own."""
WHOLE = "explorer"
"""Name of the script of the whole page."""
SCRIPTS = (WHOLE, *SCENES)
NAME = "explorer.json"
"""File of the scripts by their names and of the hash of their parts, beside the page's module."""


def program(name: str = WHOLE) -> str:
    """Return the script of the page or of a scene alone, for it and its workers.

    Raises
    ------
    MissingKernelsError
        If the build has made none, or the parts have changed since.
    """
    scripts = kept_scripts(libraries_folder() / NAME)
    if scripts is None:
        raise MissingKernelsError(
            "the script of the page",
            Words("is not in this installation, or its parts have changed"),
            "bun makes it when the package is built",
            "put bun on PATH and run `make library` in a checkout, or install the package again",
        )
    return scripts[name]


def kept_scripts(file: Path) -> dict[str, str] | None:
    """Read the scripts by their names; return None unless all are there, made of these parts."""
    try:
        scripts: dict[str, str] = json.loads(file.read_text("utf-8"))
        whole = scripts.keys() >= {"parts", *SCRIPTS}
    except (OSError, ValueError, AttributeError):
        return None
    return scripts if whole and parts_hash() in {"", scripts["parts"]} else None


def parts_hash() -> str:
    """Return the hash of all modules of the page; empty in a wheel, which holds none."""
    files = sorted(PARTS.rglob("*.mjs"))
    digest = hashlib.sha256()
    for file in files:
        digest.update(f"{file.relative_to(PARTS).as_posix()}\0".encode() + file.read_bytes())
    return digest.hexdigest() if files else ""
