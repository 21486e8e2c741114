"""Proofs in ball arithmetic, and certificates that anyone can check."""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub("rocksteady", __file__)
