"""Scores of tests that were held out, and of simpler rules beside them."""
