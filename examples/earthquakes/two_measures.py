"""
Where does a second measure of the shaking change the answer?
=============================================================

Left, the probability that a cabinet falls, fitted over PGA and PGV together, and the demand at
which it differs most from the curve over PGV alone. Right, that curve, and dashed the other fit
at the ratio of the two peaks of that demand. See :doc:`/guides/fragility`.
"""

import matplotlib.pyplot as plt
import numpy as np

import rocksteady as rs

cabinet, suite = rs.Block.rectangle(width=0.45, height=1.8), rs.motions.make_synthetic_suite(24)
options = rs.risk.FitOptions(states=["overturned"], bands=None)
levels = rs.risk.Levels("pgv_m_s", np.geomspace(0.15, 1.2, 8))
fragility = rs.compute_fragility(cabinet, suite, levels=levels, fitting=options)
curve, measure = fragility.state("overturned").curve, rs.measures.compute_measure
ratios = [measure(each, "pgv_m_s") / measure(each, "pga_g") for each in suite]
pgv, ratio = np.meshgrid(np.geomspace(0.15, 1.2, 100), np.quantile(ratios, [0.1, 0.9]))
together = fragility.surface.probability(np.stack([pgv / ratio, pgv], axis=-1))
apart = np.abs(together - curve.probability(pgv)) * (pgv / ratio > np.tan(cabinet.alpha))
row, most = np.unravel_index(apart.argmax(), apart.shape)
demand = {"pga_g": float((pgv / ratio)[row, most]), "pgv_m_s": float(pgv[row, most])}

fig, (left, right) = plt.subplots(1, 2, figsize=(7.36, 4.2), layout="constrained")
rs.plots.fragility_surface(fragility, left, **demand)
rs.plots.fragility(fragility, right, legend="below").set_title("")
right.plot(pgv[row], together[row], "--", color=right.yaxis.label.get_color())
