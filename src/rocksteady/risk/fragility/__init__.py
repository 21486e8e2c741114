"""Fragility: the probability of each damage state, from an ensemble of runs."""
