"""Windows and scales of overturning, and the kicks that suffice."""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub("rocksteady", __file__)
