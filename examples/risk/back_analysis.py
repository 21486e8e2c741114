"""
How strong was the shaking in a cemetery?
=========================================

Of ten gravestones four fell: on the left, by slenderness and size. On the right, the region holds
the pairs of peak acceleration and velocity that agree with that. Each thin line is one record at
all its scales. The survey is made up. See :doc:`/guides/back-analysis`.
"""

import matplotlib.pyplot as plt

import rocksteady as rs

stones = [
    rs.calibration.ObjectPrior(
        name=f"grave {k}", width_m=0.12 + 0.025 * k, height_m=0.9, base="0.9:1.0"
    )
    for k in range(10)
]
fell = [True, True, True, False, True, False, False, False, False, False]
survey = rs.calibration.Survey(objects=stones, fell=fell)
scan = rs.calibration.ScanOptions(levels=16, draws=4)
region = rs.back_analyse(survey, rs.motions.make_synthetic_suite(16), scan=scan)
_, (left, right) = plt.subplots(1, 2, layout="constrained")
rs.plots.survey(survey, left)
rs.plots.back_analysis(region, right)
