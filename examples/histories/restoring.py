"""
How far is the linear model right?
==================================

The moment that turns a tilted block back, over the weight times the half-diagonal, for blocks of
three slendernesses. It falls to nothing at the tipping angle, where each curve ends. Dashed, the
linear model: it is close for the slender block, and too stiff for the stocky one. See
:doc:`/theory/nonlinear`.
"""

import matplotlib.pyplot as plt
import numpy as np

import rocksteady as rs

fig, ax = plt.subplots(layout="constrained")
for width in (0.2, 0.6, 1.2):
    alpha = rs.Block.rectangle(width=width, height=1.2).alpha
    tilt = np.linspace(0.0, alpha, 100)
    degrees = np.degrees(tilt)
    ax.plot(degrees, np.sin(alpha - tilt), "C0")
    ax.plot(degrees, alpha - tilt, "C0", lw=0.9, dashes=(5, 2.5))
    name = f"{width} m x 1.2 m\nα = {degrees[-1]:.0f}°"
    ax.annotate(name, (0.0, alpha), (8, 2), textcoords="offset points", color="C0")
ax.annotate("linear model", (15.0, 0.53), (8, 4), textcoords="offset points", color="C0")
ax.set(xlabel="tilt  θ [°]", ylabel="restoring moment / (M g R)", xlim=(0, 50), ylim=(0, 0.95))
