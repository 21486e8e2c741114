"""Kinds of gridded results, recognised by their names, and the modules that describe them."""

import importlib
from collections.abc import Collection, Mapping
from typing import TYPE_CHECKING

from rocksteady.results.description import Description

if TYPE_CHECKING:
    import xarray as xr

describers: dict[str, tuple[frozenset[str], str]] = {}
"""By kind, as "attractor map": variables and attributes that a dataset of it has, and the module
whose function ``describe(dataset)`` describes it.  The first kind that fits counts."""


def use_describers(kinds: Mapping[str, tuple[Collection[str], str]]) -> None:
    """Decide which module describes which kind of dataset.

    Datasets are made below the modules that describe them, so that the package's namespace, which
    imports both, connects them.

    Parameters
    ----------
    kinds
        For `describers`.
    """
    for kind, (names, module) in kinds.items():
        describers[kind] = frozenset(names), module


def kind_of(dataset: "xr.Dataset") -> str:
    """Return the kind of a dataset; empty where none fits."""
    names = {str(name) for name in (*dataset.data_vars, *dataset.attrs)}
    return next((kind for kind, (needed, _) in describers.items() if needed <= names), "")


def described(dataset: "xr.Dataset") -> Description | None:
    """Return the description of a dataset of a known kind; None for any other."""
    kind = kind_of(dataset)
    if not kind:
        return None
    description: Description = importlib.import_module(describers[kind][1]).describe(dataset)
    return description
