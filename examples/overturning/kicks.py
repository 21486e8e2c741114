"""
When is a rocking block most easily overturned?
===============================================

Below, a block rocks freely; above, the least sudden change of the base velocity that overturns it,
at each moment and to either side. It needs least when the block passes upright, towards the side
to which it moves, and most towards the other. See :doc:`/guides/overturning`.
"""

import matplotlib.pyplot as plt
import numpy as np

import rocksteady as rs

block = rs.DimensionlessBlock(restitution=0.9)
start = rs.State(angle=0.0, velocity=0.7)
times = np.linspace(0.0, 5.0, 61)
fig, (top, bottom) = plt.subplots(2, sharex=True, figsize=(7.36, 5.0), layout="constrained")
rs.plots.fatal_kicks(rs.find_fatal_kicks(block, start=start, times_pt=times), top, legend="right")
run = rs.simulate(block, rs.Still(), start=start)
rs.plots.trajectory(run, bottom, span=(0.0, 5.0), key=False)
top.set_xlabel("")
