"""Many motions, one after the other: the plain loops that the sweeps call."""
