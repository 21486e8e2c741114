"""Many cases: a grid of axes, a function of its cells, a labelled result.

==============  ==================================================================================
`axes`          axes, the grid that they span, and what is computed in each of its cells
`executors`     who runs the pieces of a grid: this thread, or several
`evaluate`      the one loop over cases: deals a grid out, puts the answers together, labels them
==============  ==================================================================================

Nothing here knows what a cell means.
"""
