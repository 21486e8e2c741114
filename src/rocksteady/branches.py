"""Steady motions over a parameter: branches, bifurcations and their curves."""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub("rocksteady", __file__)
