"""Branches of periodic orbits over a parameter, and their bifurcations."""
