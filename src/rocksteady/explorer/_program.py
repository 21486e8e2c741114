"""The page's script: shortened where that was done for these parts, else as they are."""

import hashlib
from pathlib import Path

from rocksteady.errors import MissingKernelsError
from rocksteady.explorer._bundle import ENTRY, PARTS, script
from rocksteady.explorer.module import page_module
from rocksteady.kernels.machine_code.library import installed_folder

SCENES = ("push", "swing", "size", "fall", "fates", "order", "quake")
"""Places of the page's story, each of which has a script of its own."""
NAME = "explorer.js"
"""File of the shortened script, beside the page's module."""
NAMES: dict[str | None, str] = {None: NAME, **{scene: f"scene-{scene}.js" for scene in SCENES}}
"""Files of the shortened scripts, of the page and of each scene alone."""


def entry_of(scene: str | None) -> Path:
    """Return the module at which the script of the page, or of a scene alone, begins."""
    return ENTRY if scene is None else PARTS / "embed" / f"{scene}.mjs"


def program(scene: str | None = None) -> str:
    """Return the script of the page or of a scene alone, for it and its workers.

    The shortened one does the same with shorter names; it is taken only if it was made from these
    parts, and from beside the page's module, where no other user can write.  A wheel brings the
    shortened one without the parts.
    """
    name = NAMES[scene]
    if not ENTRY.is_file():
        return (installed_folder() / name).read_bytes().decode("utf-8")
    whole = script(entry_of(scene))
    try:
        program_text = (page_module().parent / name).read_bytes().decode("utf-8")
    except (MissingKernelsError, OSError, ValueError):
        return whole
    return program_text if program_text.startswith(heading(whole)) else whole


def heading(whole: str) -> str:
    """Return the first line of what was made from a script, which holds its hash."""
    return f"/* {hashlib.sha256(whole.encode('utf-8')).hexdigest()} */\n"
