"""Intensity measures, response spectra and integrals of ground-motion records."""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub("rocksteady", __file__)
