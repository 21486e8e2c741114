"""
Where does a second measure of the shaking change the answer?
==============================================================

Left, the probability that a cabinet falls, fitted over PGA and PGV together, and the demand of
this suite at which it differs most from the curve over PGV alone. Right, that curve, and the
cut through the other fit at the ratio of the two peaks of that demand. See
:doc:`/guides/fragility`.
"""

import matplotlib.pyplot as plt
import numpy as np

import rocksteady as rs

cabinet = rs.Block.rectangle(width=0.45, height=1.8)
suite = rs.motions.make_synthetic_suite(24)
fragility = rs.compute_fragility(
    cabinet,
    suite,
    levels=rs.risk.Levels("pgv_m_s", np.geomspace(0.15, 1.2, 8)),
    fitting=rs.risk.FitOptions(states=["overturned"], bands=None),
)
curve, surface = fragility.state("overturned").curve, fragility.surface
ratios = [
    rs.measures.compute_measure(record, "pgv_m_s") / rs.measures.compute_measure(record, "pga_g")
    for record in suite
]
pgv, ratio = np.meshgrid(np.geomspace(0.15, 1.2, 100), np.quantile(ratios, [0.1, 0.9]))
together = surface.probability(np.stack([pgv / ratio, pgv], axis=-1))
lifts = pgv / ratio > np.tan(cabinet.alpha)  # in g
apart = np.where(lifts, np.abs(together - curve.probability(pgv)), 0.0)
most = np.unravel_index(apart.argmax(), apart.shape)

fig, (left, right) = plt.subplots(1, 2, figsize=(7.36, 4.2), layout="constrained")
rs.plots.fragility_surface(
    fragility, left, pga_g=float(pgv[most] / ratio[most]), pgv_m_s=float(pgv[most])
)
rs.plots.fragility(fragility, right, legend="below").set_title("")
ink = right.yaxis.label.get_color()
right.plot(pgv[most[0]], together[most[0]], "--", color=ink)
right.annotate(
    "by both peaks",
    (float(np.interp(0.95, together[most[0]], pgv[most[0]])), 0.95),
    (-8.0, 0.0),
    textcoords="offset points",
    ha="right",
    fontsize=8.0,
)
