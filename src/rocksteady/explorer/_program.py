"""The page's script: shortened where that was done for these parts, else as they are."""

import hashlib

from rocksteady.errors import MissingKernelsError
from rocksteady.explorer._bundle import ENTRY, script
from rocksteady.explorer.module import page_module
from rocksteady.kernels.machine_code.library import installed_folder

NAME = "explorer.js"
"""File of the shortened script, beside the page's module."""


def program() -> str:
    """Return the script of the page, for the page and its workers.

    The shortened one does the same with shorter names; it is taken only if it was made from these
    parts, and from beside the page's module, where no other user can write.  A wheel brings the
    shortened one without the parts.
    """
    if not ENTRY.is_file():
        return (installed_folder() / NAME).read_bytes().decode("utf-8")
    whole = script()
    try:
        program_text = (page_module().parent / NAME).read_bytes().decode("utf-8")
    except (MissingKernelsError, OSError, ValueError):
        return whole
    return program_text if program_text.startswith(heading(whole)) else whole


def heading(whole: str) -> str:
    """Return the first line of what was made from a script, which holds its hash."""
    return f"/* {hashlib.sha256(whole.encode('utf-8')).hexdigest()} */\n"
