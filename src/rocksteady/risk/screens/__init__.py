"""Published formulas for uplift, rocking and overturning, side by side."""
