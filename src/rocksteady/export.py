"""Files for others: datasets, tables, loss models, reports, and the explorer's page."""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub("rocksteady", __file__)
