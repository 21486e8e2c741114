"""
Which of these motions are stable?
==================================

Left, the multipliers of the periodic motions found under the same shaking: a motion is stable where
both of its multipliers lie inside the unit circle. Right, the impacts of the same motions. See
:doc:`/theory/orbits`.
"""

import matplotlib.pyplot as plt

import rocksteady as rs

block = rs.DimensionlessBlock(restitution=0.9)
shaking = rs.Harmonic(amplitude=3.0, frequency_ratio=6.0)
orbits = [each for each in rs.find_orbits(block, shaking, max_period=3) if each.admissible]
fig, (left, right) = plt.subplots(1, 2, figsize=(7.36, 4.4), layout="constrained")
rs.plots.multipliers(orbits, left, legend="below")
rs.plots.poincare_section(orbits, right)
