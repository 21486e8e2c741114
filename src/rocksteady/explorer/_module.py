"""Finding the WebAssembly module that the page holds: kernels compiled ahead of time."""

from pathlib import Path

from rocksteady.errors import MissingKernelsError, Words
from rocksteady.kernels.machine_code.library import is_whole
from rocksteady.kernels.machine_code.sources import libraries_folder, sources_hash

NAME = "explorer.wasm"
"""File of the module."""
BEGINS = b"\0asm\1\0\0\0"
"""First bytes of every module of this version of WebAssembly."""


def page_module() -> Path:
    """Return the WebAssembly module of these sources of the kernels.

    Raises
    ------
    MissingKernelsError
        If the package has none that can be used.

    Examples
    --------
    >>> from rocksteady.explorer._module import page_module
    >>> page_module().name
    'explorer.wasm'
    """
    path = libraries_folder() / NAME
    if reason := fault(path):
        raise MissingKernelsError(
            f"{NAME}, the kernels of the page,",
            Words(f"cannot be used ({reason})"),
            "the build of the package makes it",
            "run `make library` in a checkout, or install the package again",
        )
    return path


def fault(path: Path) -> str:
    """Return why a module is not used; an empty text if it can be."""
    if not path.is_file():
        return "it is not there"
    if not is_whole(path):
        return f"{path} is damaged"
    content = path.read_bytes()
    if not content.startswith(BEGINS):
        return f"{path} is no WebAssembly module"
    if sources_hash().encode() not in content:
        return f"{path} was made from other sources"
    return ""
