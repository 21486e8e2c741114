"""
How far do records move a facade?
=================================

The largest displacement of a facade under each of nine records in both directions, as a part of
the displacement at which it falls; arrows are falls. Four of the nine records overturn it. The two
lines to the left are the limits of the code for the mean. See :doc:`/guides/facades`.
"""

import rocksteady as rs

wall = rs.codes.Facade(name="front", thickness_m=0.4, height_m=4.0)
runs = rs.codes.run_facade(wall, rs.motions.make_synthetic_suite(9), pga_g=0.4)
ax = rs.plots.facade_runs(runs)
ax.set_title("Wall of 0.4 m x 4 m, records scaled to 0.4 g", pad=18)
