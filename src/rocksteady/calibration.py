"""Calibration on shake-table tests, and surveys after earthquakes."""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub("rocksteady", __file__)
