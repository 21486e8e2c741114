"""
Where do the motions change?
============================

Bifurcations of periodic motions as curves over frequency and amplitude, with the points at which
two of them meet. Between the curves the motions keep their kind and stability. See
:doc:`/theory/codimension-two`.
"""

import rocksteady as rs

block = rs.DimensionlessBlock(restitution=0.87)
shaking = rs.Harmonic(amplitude=3.0, frequency_ratio=4.2)
search = rs.branches.CurveOptions(orders=(3,), lines=(1, 1), max_impacts=2, max_period=3)
curves = rs.find_bifurcation_curves(block, shaking, within=((4.4, 5.4), (2.5, 4.0)), search=search)
ax = rs.plots.bifurcation_curves(curves)
