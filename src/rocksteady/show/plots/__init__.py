"""Plots: each takes a result and, optionally, axes; draws; and returns the axes.

The figures of `rocksteady.show.figures` put several together.
"""
