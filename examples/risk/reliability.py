"""
Are the predicted probabilities honest?
=======================================

Four checks on tests that the calibration has not seen: whether the predicted number falls; whether
one record is out of line; how the score depends on the weight that the tests are given; and how
accurate the model and two simpler rules become with the number of records. See
:doc:`/guides/calibration`.
"""

import matplotlib.pyplot as plt

import rocksteady as rs

column = rs.Block.rectangle(width=0.15, height=0.6)
tests = rs.calibration.make_synthetic_tests(
    column, rs.motions.make_synthetic_suite(10), model=rs.Linear()
)
sampling = rs.calibration.DrawOptions(draws=200, gains=3, rounds=2)
calibration = rs.calibrate(tests, sampling=sampling, model=rs.Linear())
fig, axes = plt.subplots(2, 2, figsize=(7.36, 7.0), layout="constrained")
rs.plots.reliability(calibration, axes[0, 0])
rs.plots.residuals(calibration, axes[0, 1])
rs.plots.temper(calibration, axes[1, 0])
rs.plots.learning(calibration, axes[1, 1])
