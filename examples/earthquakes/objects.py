"""
Which object first?
===================

A table of objects under one demand, the worst on top, and what stands behind it: demand over
capacity by published formulas, and the hazard of a site. See :doc:`/guides/objects`.
"""

import matplotlib.pyplot as plt
import numpy as np

import rocksteady as rs

sizes = {"bottle": (0.08, 0.3), "vase": (0.14, 0.5), "shelf": (0.35, 1.6), "chest": (0.9, 1.1)}
objects = [
    rs.risk.DescribedObject(values={"name": name, "geometry": {"width_m": b, "height_m": h}})
    for name, (b, h) in sizes.items()
]
demand = rs.Demand(pga_g=0.35, pgv_m_s=0.4)
peaks = rs.risk.Peaks(pga_g=0.35, pgv_m_s=0.4)
table = rs.assess_objects(objects, rs.motions.make_synthetic_suite(28), demand=peaks)
levels = np.geomspace(0.05, 2.0, 12)
hazard = rs.risk.HazardCurve(measure="pgv_m_s", levels=levels, rates=4e-4 * levels**-2)
fig, axes = plt.subplots(3, 1, figsize=(7.4, 8.6), layout="constrained")
rs.plots.objects(table, axes[0])
rs.plots.screens(rs.screen_block(rs.Block.rectangle(width=0.35, height=1.6), demand), axes[1])
rs.plots.hazard_curve(hazard, axes[2])
