"""The public names of the package: those on top and those of its public modules."""

from types import ModuleType
from typing import Any

import rocksteady

MODULES = tuple(
    name for name in rocksteady.__all__ if isinstance(getattr(rocksteady, name), ModuleType)
)
"""The public modules."""
THINGS: dict[str, Any] = {}
"""What is public by the name with which it is defined, as ``Trajectory``."""
PLACES: dict[str, str] = {}
"""How each is reached from the package, as ``histories.Trajectory``."""
COMMON_WORDS = frozenset({"add", "cut", "delay", "join", "scale"})
"""Functions whose names alone mean other things too: ``motions.scale``, not ``scale``."""

for _holder in (rocksteady, *(getattr(rocksteady, name) for name in MODULES)):
    _before = _holder.__name__.removeprefix("rocksteady").removeprefix(".")
    for _name in _holder.__all__:
        if _holder is not rocksteady or _name not in MODULES:
            _thing = getattr(_holder, _name)
            _own = getattr(_thing, "__name__", _name)
            assert _own not in THINGS, f"two public things are called {_own}"
            THINGS[_own], PLACES[_own] = _thing, f"{_before}.{_name}".removeprefix(".")
