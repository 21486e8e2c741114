"""The page's script: shortened where that was done for these parts, else as they are."""

import hashlib
import json
from pathlib import Path

from rocksteady.errors import MissingKernelsError, Words
from rocksteady.explorer._bundle import ENTRY, PARTS, script
from rocksteady.explorer.module import page_module
from rocksteady.kernels.machine_code.library import installed_folder

SCENES = ("push", "swing", "size", "fall", "fates", "order", "quake")
"""Places of the page's story, each of which has a script of its own."""
WHOLE = "explorer"
"""Name of the script of the whole page."""
SCRIPTS = (WHOLE, *SCENES)
NAME = "explorer.json.xz"
"""File of the shortened scripts by their names, beside the page's module."""


def entry_of(name: str) -> Path:
    """Return the module at which the script of the page, or of a scene alone, begins."""
    return ENTRY if name == WHOLE else PARTS / "embed" / f"{name}.mjs"


def program(name: str = WHOLE) -> str:
    """Return the script of the page or of a scene alone, for it and its workers.

    The shortened one does the same with shorter names; it is taken only if it was made from these
    parts, and from beside the page's module, where no other user can write.  A wheel brings the
    shortened one without the parts.
    """
    if not ENTRY.is_file():
        return shortened_scripts(installed_folder() / NAME)[name]
    whole = script(entry_of(name))
    try:
        short = shortened_scripts(page_module().parent / NAME).get(name, "")
    except (MissingKernelsError, OSError):
        return whole
    return short if short.startswith(heading(whole)) else whole


def shortened_scripts(file: Path) -> dict[str, str]:
    """Read the shortened scripts by their names.

    Raises
    ------
    MissingKernelsError
        If this Python has no module that unpacks them, or the file is damaged.
    """
    try:
        import lzma
    except ImportError as error:
        raise MissingKernelsError(
            "lzma, the module of Python that unpacks the page's script,",
            Words("cannot be imported"),
            "a Python built without the library liblzma lacks it",
            "install another build of Python",
        ) from error
    try:
        scripts: dict[str, str] = json.loads(lzma.decompress(file.read_bytes()))
    except (lzma.LZMAError, ValueError) as error:
        raise MissingKernelsError(
            str(file), Words("is damaged"), "it holds scripts packed as JSON", "install it again"
        ) from error
    return scripts


def heading(whole: str) -> str:
    """Return the first line of what was made from a script, which holds its hash."""
    return f"/* {hashlib.sha256(whole.encode('utf-8')).hexdigest()} */\n"
