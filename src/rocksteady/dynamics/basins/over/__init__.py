"""Shares of basins over a parameter, with labels that stay with their orbits."""
