"""Many cases: a grid, a function of its cells, a labelled result.  Knows no physics."""
