"""Finding the WebAssembly module that the page holds: kernels compiled ahead of time.

A page runs what the module does. So it is taken only from the package itself, or from a folder that
no other user can change, and only where it was made from these sources of the kernels.
"""

import hashlib
from contextlib import suppress
from pathlib import Path

from rocksteady.errors import MissingKernelsError, Words
from rocksteady.kernels.machine_code.library import (
    built_folder,
    checksum_file,
    installed_folder,
    make_built_folder,
)
from rocksteady.kernels.machine_code.sources import sources_hash

NAME = "explorer.wasm"
"""File of the module."""
BEGINS = b"\0asm\1\0\0\0"
"""First bytes of every module of this version of WebAssembly."""


def page_module() -> Path:
    """Return the WebAssembly module of these sources of the kernels.

    Raises
    ------
    MissingKernelsError
        If there is none, neither in the package nor built on this machine.

    Examples
    --------
    >>> from rocksteady.explorer.module import page_module
    >>> page_module().name
    'explorer.wasm'
    """
    reason = "it is not there"
    for folder in (installed_folder(), built_folder()):
        path = folder / NAME
        if path.is_file():
            reason = fault(path, built=folder == built_folder())
            if not reason:
                return path
    raise MissingKernelsError(
        f"{NAME}, the kernels of the page,",
        Words(f"cannot be used ({reason})"),
        "a wheel brings it along, and a checkout builds it",
        "run `make library` in a checkout, or install a wheel of this version",
    )


def fault(path: Path, *, built: bool = False) -> str:
    """Return why a module is not used; an empty text if it can be.

    Parameters
    ----------
    path
        Path of the module.
    built
        Whether it was built on this machine, in a folder that must be private and beside its
        checksum.
    """
    try:
        if built and (folder := make_built_folder()) is not None:
            return folder
        content = path.read_bytes()
        expected = checksum_file(path).read_text("ascii").split()[:1] if built else None
    except (OSError, ValueError) as error:
        return f"{path} cannot be read: {error}"
    if not content.startswith(BEGINS):
        return f"{path} is no WebAssembly module"
    if expected is not None and [hashlib.sha256(content).hexdigest()] != expected:
        return f"{path} is damaged"
    if sources_hash().encode() not in content:
        return f"{path} was made from other sources"
    return ""


def prune() -> None:
    """Remove modules built beside libraries of other versions that are removed already.

    `rocksteady.kernels.machine_code` removes libraries that have not been used for long.
    """
    current = built_folder()
    if make_built_folder() is not None:
        return
    for folder in current.parents[1].glob(f"{'[0-9a-f]' * 16}/{current.name}"):
        with suppress(OSError):
            files = list(folder.iterdir())
            if folder != current and all(file.name.startswith("explorer.") for file in files):
                for file in files:
                    file.unlink()
                folder.rmdir()
                folder.parent.rmdir()
