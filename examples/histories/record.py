"""
Does a bookcase survive this record?
====================================

It rocks and comes to rest. Above, its rotation, with marks at the impacts: beyond ±1 the mass
centre would be past the pivot. Below, the acceleration of the ground; the dashed lines are what
lifts the bookcase from rest. See :doc:`/guides/records`.
"""

import matplotlib.pyplot as plt

import rocksteady as rs

bookcase = rs.Block.rectangle(width=0.35, height=1.9)
record = rs.motions.make_synthetic_suite(8)[4].scaled(1.5)
run = rs.simulate(bookcase, record)
fig, (top, bottom) = plt.subplots(2, sharex=True, height_ratios=(2, 1), layout="constrained")
rs.plots.trajectory(run, top)
rs.plots.base(run, bottom)
top.set_title(f"Bookcase of 0.35 m x 1.9 m: {run.status.label}, peak {run.peak:.2f} α")
top.set_xlabel("")
