"""How a function is evaluated over a grid, in parallel, and its results stored.

It contains no physics.
"""
