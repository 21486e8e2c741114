"""
What does a block do in one pulse?
==================================

Four moments, to scale: the pulse lifts the block, throws it back, it strikes the base with its
other corner (the ring) and falls. The triangle is the pivot, the circle the mass centre; once that
has left the blue band, gravity pulls the block over. The arrow is the acceleration of the base,
beside the marks of what lifts a block from rest. See :doc:`/guides/overturning`.
"""

import matplotlib.pyplot as plt

import rocksteady as rs

block = rs.Block.rectangle(width=0.5, height=2.0)
pulse = rs.Pulse(shape="one-sine", amplitude=3.5, frequency_ratio=4.0)
run = rs.simulate(block, pulse)
fig, axes = plt.subplots(2, 2, figsize=(7.36, 6.4), layout="constrained")
impact = run.impacts.pt[0]
for ax, pt in zip(axes.flat, (0.2 * impact, 0.6 * impact, 1.1 * impact, 2.0 * impact), strict=True):
    rs.plots.block(run, ax, pt=pt)
