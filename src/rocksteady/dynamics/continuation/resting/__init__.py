"""Orbits with rest phases, continued over a parameter."""
