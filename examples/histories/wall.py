"""
What does a wall behind a block change?
=======================================

Above, a block that is let go of and stands free; below, the same block against a wall. At the wall
it is thrown back with half of its velocity and less, so that it rests after a few impacts, and it
never leans to the other side. See :doc:`/theory/one-sided`.
"""

import matplotlib.pyplot as plt

import rocksteady as rs

block, start = rs.Block.rectangle(width=0.3, height=1.8), rs.State(angle=0.6, velocity=0.0)
fig, axes = plt.subplots(2, sharex=True, figsize=(7.36, 4.6), layout="constrained")
for ax, each, name in zip(
    axes, (block, block.against_wall()), ("free", "against a wall"), strict=True
):
    run = rs.simulate(each, rs.Still(), start=start)
    rs.plots.trajectory(run, ax, key=False).set(title=name, xlim=(0.0, 5.0))
axes[0].set_xlabel("")
