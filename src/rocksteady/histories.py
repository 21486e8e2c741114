"""What a run returns: its course, its impacts, and its neighbours."""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub("rocksteady", __file__)
