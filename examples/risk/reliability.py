"""
Are the predicted probabilities honest?
=======================================

Three checks on tests that the calibration has not seen: whether the predicted number falls; whether
one record is out of line; and how accurate the model and two simpler rules become with the number
of records. See :doc:`/guides/calibration`.
"""

import matplotlib.pyplot as plt

import rocksteady as rs

column = rs.Block.rectangle(width=0.15, height=0.6)
tests = rs.calibration.make_synthetic_tests(
    column, rs.motions.make_synthetic_suite(10), model=rs.Linear()
)
calibration = rs.calibrate(tests, model=rs.Linear())
fig, axes = plt.subplots(3, 1, figsize=(7.36, 9.0), layout="constrained")
rs.plots.reliability(calibration, axes[0])
rs.plots.residuals(calibration, axes[1])
rs.plots.learning(calibration, axes[2])
