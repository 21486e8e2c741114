"""Impacts without speed, at which no derivative exists, for callers in Python."""

from typing import Any

from rocksteady.kernels.core import forcing


def grazes(landing: float, amplitude: float, frequency: float) -> bool:
    """Return whether an impact is so slow that no derivative exists there.

    Parameters are those of `rocksteady.kernels.core.forcing.grazes`, which runs as Python here:
    one call decides for an orbit, and no entry of the library would be faster.
    """
    kernel: Any = forcing.grazes
    return bool(kernel.py_func(landing, amplitude, frequency))
