"""A picture for each kind of result."""

import lazy_loader

_load, _, _names = lazy_loader.attach_stub("rocksteady", __file__)
__all__ = [name.removeprefix("plot_") for name in _names]
__all__.sort()


def __getattr__(name: str) -> object:
    """Return the function that draws `name`: where it is defined its name begins with ``plot_``."""
    if name not in __all__:
        raise AttributeError(f"No rocksteady.plots attribute {name}")
    return _load(name if name == "animate" else f"plot_{name}")


def __dir__() -> list[str]:
    return __all__
