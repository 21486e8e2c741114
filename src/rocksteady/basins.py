"""Which starts end where: basins, their boundaries, edges between them."""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub("rocksteady", __file__)
