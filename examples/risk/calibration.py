"""
What do shaking tests teach about an object?
============================================

Left, the tests of a column by record and gain: whether it fell, and the calibrated probability
that it does; rings mark the outcomes that were not expected. Right, its slenderness before and
after the tests. The tests are synthetic. See :doc:`/guides/calibration`.
"""

import matplotlib.pyplot as plt

import rocksteady as rs

column = rs.Block.rectangle(width=0.15, height=0.6)
tests = rs.calibration.make_synthetic_tests(
    column, rs.motions.make_synthetic_suite(8), model=rs.Linear()
)
calibration = rs.calibrate(tests, model=rs.Linear())
fig, (left, right) = plt.subplots(1, 2, figsize=(7.36, 4.4), layout="constrained")
rs.plots.test_ladders(calibration, left)
rs.plots.posterior(calibration, right)
