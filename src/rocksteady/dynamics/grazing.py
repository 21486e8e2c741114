"""Impacts without speed, at which no derivative exists, for callers in Python."""

from typing import Any

from rocksteady.kernels.core import forcing


def grazes(landing: float, amplitude: float, frequency: float) -> bool:
    """Return whether an impact is so slow that no derivative exists there.

    Parameters are those of `rocksteady.kernels.core.forcing.grazes`, which runs as Python here:
    one call decides for an orbit, and no entry of the library would be faster.
    """
    rule: Any = getattr(forcing.grazes, "py_func", forcing.grazes)  # without kernels it is plain
    return bool(rule(landing, amplitude, frequency))
