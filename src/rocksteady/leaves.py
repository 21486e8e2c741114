"""Leaves: features that nothing else imports, each one folder with all of its own.

What stands below a leaf names it here, in lists of commands and of executors, and in the stubs of
public names. A leaf whose folder is deleted is missing there, and everything else goes on.
"""

from importlib import import_module
from importlib.util import find_spec
from types import ModuleType
from typing import Final

LEAVES: Final = ("certify", "explorer", "facades", "gpu", "studies")
NO_GPU: Final = "this installation has no part for GPUs"
"""What is wrong where the leaf `gpu` is missing."""


def import_if_present(name: str) -> ModuleType | None:
    """Import a module of the package, as ``facades.command``.

    Parameters
    ----------
    name
        Its name below ``rocksteady``.

    Returns
    -------
    module or None
        None if it is part of a leaf whose folder has been deleted.
    """
    leaf = name.partition(".")[0]
    if leaf in LEAVES:
        spec = find_spec(f"rocksteady.{leaf}")
        if spec is None or spec.origin is None:  # a folder of caches alone is no leaf
            return None
    return import_module(f"rocksteady.{name}")
