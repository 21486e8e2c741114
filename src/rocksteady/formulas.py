"""Closed forms of free rocking, impacts, overturning and steady motions."""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub("rocksteady", __file__)
