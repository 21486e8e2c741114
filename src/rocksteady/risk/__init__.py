"""Fragility, code screens, hazard, risk and assessment of objects that may fall."""
