"""Plots of fragility, risk, sensitivity and tables of objects."""
