"""Periodic orbits and attractors: the return map, one orbit, all of them, what is settled to."""
