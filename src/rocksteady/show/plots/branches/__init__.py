"""Branches of periodic motions and curves of their bifurcations, drawn over parameters."""
