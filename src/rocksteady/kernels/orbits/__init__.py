"""Periodic motions: the return map and its orbits, in closed form or by Newton's method."""
