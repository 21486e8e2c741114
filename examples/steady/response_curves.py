"""
How high does a block rock?
===========================

The peak of steady symmetric rocking over the frequency of the shaking, at three amplitudes. Solid
lines are stable and can be observed; dashed ones are unstable. The smallest amplitude cannot lift
a block from rest, yet a block that is set rocking goes on. See :doc:`/theory/steady`.
"""

import numpy as np

import rocksteady as rs

block = rs.DimensionlessBlock(restitution=0.8)
ratios = np.linspace(0.8, 8.0, 700)
curves = [rs.compute_response_curve(block, a, frequency_ratio=ratios) for a in (0.7, 1.5, 3.0)]
ax = rs.plots.response(curves, top=1.6)
ax.set_title("Peak of steady rocking, restitution 0.8")
