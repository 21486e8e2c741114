"""Periodic motions: the return map, its orbits in closed form or by Newton's method."""
