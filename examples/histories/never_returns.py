"""
When is it certain that a block falls?
======================================

The sum of angle and velocity of a flight lies in a band about a curve that grows like e^t. A block
can come down only where this sum is below 0. Once the whole band is above 0 the block never
returns, whatever the shaking still does: there the computation may stop. See :doc:`/theory/march`.
"""

import matplotlib.pyplot as plt
import numpy as np

import rocksteady as rs

block = rs.DimensionlessBlock(restitution=0.9)
shaking = rs.Harmonic(amplitude=5.0, frequency_ratio=3.0)
(beta, half), t = 5.0 / np.array([1.0 + 3.0**2, np.hypot(1.0, 3.0)]), np.linspace(0.0, 2.7, 300)
middle = (0.5 - 0.8 - 1.0 + 3.0 * beta) * np.exp(t) + 1.0
state = rs.simulate(block, shaking, start=rs.State(angle=0.5, velocity=-0.8))(t)
sure = t[np.argmax(middle > half)]
fig, ax = plt.subplots(layout="constrained")
ax.fill_between(t, middle - half, middle + half, color="C0", alpha=0.2, lw=0)
ax.plot(t, state.angle + state.velocity, "C0")
ax.plot(t, state.angle, "C0", lw=0.9)
ax.axhline(0.0, color="C4", lw=0.7)
ax.axvline(sure, color="C4", dashes=(5, 2.5), lw=1.0)
ax.text(0.75, 2.6, "angle + velocity", color="C0", ha="right")
ax.text(2.2, 1.8, "angle", color="C0")
ax.text(1.05, 5.0, "never returns\nafter this", ha="right")
ax.set(xlabel="pivot time  pt", ylabel="in units of α", xlim=(0, 2.7))
