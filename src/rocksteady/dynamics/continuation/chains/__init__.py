"""Orbits as closed chains of arcs, and the curves of solutions that they form."""
