"""
Does noise make a pulse more dangerous?
=======================================

A pulse alone overturns this block at scales of 0.4 to 0.95 and from 1.05 on, but not between them.
Noise blurs the borders: it takes away the safe gap, and it saves some blocks that the pulse alone
overturns. Bands are 90 % intervals of 40 realisations. See :doc:`/guides/overturning`.
"""

import numpy as np

import rocksteady as rs

block = rs.DimensionlessBlock(restitution=0.9)
pulse = rs.Pulse(shape="one-sine", amplitude=5.0, frequency_ratio=4.0)
noise = rs.motions.BandNoise(rms=1.0, band=(0.5, 10.0), duration=10.0, seed=1)
axes = {"level": [0.0, 0.1, 0.3], "scale": np.linspace(0.3, 1.5, 49)}
fates = rs.compute_noise_fates(block, pulse, noise, axes=axes, draws=40)
ax = rs.plots.noise_fates(fates)
ax.set_title("one-sine pulse, A = 5, Ω = 4, restitution 0.9")
