"""Ensembles: blocks on records at many levels, restitutions and signs, each cell a run."""
