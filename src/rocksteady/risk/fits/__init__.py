"""Fragility curves: maximum likelihood, confidence bands, goodness of fit."""
