"""
Which motions coexist?
======================

One block, the same shaking, two starts: one motion repeats in each period of the shaking, the other
takes three periods and rises about three times as high. Both are stable; which one is met depends
on the past. The steps at angle 0 in the right picture are the velocities lost at impacts. See
:doc:`/theory/orbits` and :doc:`/theory/basins`.
"""

import matplotlib.pyplot as plt

import rocksteady as rs

block = rs.DimensionlessBlock(restitution=0.9)
shaking = rs.Harmonic(amplitude=1.5, frequency_ratio=4.0)
fig, axes = plt.subplots(2, 2, figsize=(7.36, 5.0), width_ratios=(3, 2), layout="constrained")
orbits = [each for each in rs.find_orbits(block, shaking) if each.stable and each.admissible]
for (left, right), orbit in zip(axes, orbits, strict=True):
    run = rs.simulate(block, shaking, start=orbit.states[0], cycles=9)
    rs.plots.trajectory(run, left, key=False)
    left.set_title(f"motion of period {orbit.period}, peak {orbit.highest:.2f} α")
    rs.plots.phase_portrait(run, right, mark="impacts", legend="none")
    right.set(xlim=(-0.6, 0.6), ylim=(-1.3, 1.3))
