"""Whether the kernels of this installation compute what those of every other one do."""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
