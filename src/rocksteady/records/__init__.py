"""What a ground-motion file holds: its channels in SI units, paired and processed on request."""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
