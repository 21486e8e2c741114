"""
What does a record hold?
========================

Acceleration, velocity and displacement of the ground, integrated from rest, and the growth of the
Arias intensity, whose steep part is the strong motion. A block is overturned by velocity that
lasts rather than by acceleration. See :doc:`/guides/measures`.
"""

import matplotlib.pyplot as plt

import rocksteady as rs

record = rs.motions.make_synthetic_suite(4)[2]
course = rs.measures.integrate_record(record)
fig, axes = plt.subplots(4, sharex=True, figsize=(7.36, 6.4), layout="constrained")
for ax, quantity in zip(axes, ("acceleration", "velocity", "displacement"), strict=False):
    rs.plots.integrated_record(course, ax, quantity=quantity).set_xlabel("")
rs.plots.husid(course, axes[3])
