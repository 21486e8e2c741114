"""Fragility curves: maximum likelihood, and the distance from the counted shares."""
