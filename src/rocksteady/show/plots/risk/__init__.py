"""Plots of fragility and of what it depends on."""
