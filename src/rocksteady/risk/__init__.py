"""Fragility, code screens, hazard, risk and assessment of objects that may fall."""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
