"""Plots of fragility, risk, sensitivity and the ranking of measures."""
