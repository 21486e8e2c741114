"""Ensembles of runs: blocks on records at many levels, restitutions and signs."""
