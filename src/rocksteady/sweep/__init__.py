"""Many cases: a grid of axes, a function of its cells, a labelled result, in memory or on disk.

==============  ==================================================================================
`axes`          one coordinate: numbers, or names of things as the records of a suite
`grid`          the cells that axes span
`outputs`       what is computed in each cell
`task`          all that a worker needs: computes the cells of a piece, as far as a time lasts
`deal`          which cells are still to be handed out, and how many at once
`draws`         random numbers of cells, keyed on their numbers
`executors`     who computes them: this thread, several, or the workers of a cluster
`inputs`        what a result follows from, written down and compared
`memory`        results in memory
`store`         results on disk: where, and what to do with what is there
`chunks`        a grid in chunks
`contents`      what lies in a store
`descriptions`  what a store says of itself: made, compared, mended
`shelf`         writes a store, and verifies what is there
`reading`       reads a store, finished or not
`lazy`          arrays of a store that are read where they are used
`evaluate`      the one loop over cases, which joins them
`refine`        the same, near the borders of classes only
==============  ==================================================================================

Nothing here knows what a cell means.
"""
