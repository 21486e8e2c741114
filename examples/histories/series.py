"""
What does shaking of several harmonics do?
==========================================

Below, the base moves with the sum of three harmonics; above, the block follows with a motion that
repeats after two of its periods. Any shaking that repeats itself is such a sum. See
:doc:`/theory/periodic`.
"""

import matplotlib.pyplot as plt

import rocksteady as rs

block = rs.DimensionlessBlock(restitution=0.85)
waves = ((1, 1.0, 0.0), (2, 1.0, 1.0), (3, 1.0, 2.0))
shaking = rs.motions.FourierSeries(amplitude=1.5, frequency_ratio=4.0, harmonics=waves)
attractor = rs.find_attractor(block, shaking, start=rs.State(angle=0.3, velocity=0.0))
run = rs.simulate(block, shaking, start=attractor.start, cycles=4)
fig, (top, bottom) = plt.subplots(2, sharex=True, figsize=(7.36, 4.6), layout="constrained")
rs.plots.trajectory(run, top, key=False).set(xlabel="", ylim=(-0.5, 0.5))
rs.plots.base(run, bottom)
