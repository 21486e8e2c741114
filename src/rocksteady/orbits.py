"""Steady motions at one amplitude and frequency: closed form, orbits, attractors."""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub("rocksteady", __file__)
