"""Plots of calibrations, back-analyses and measured restitution."""
