"""
Which of these tests would the model have foreseen?
===================================================

The probability of falling in each test, predicted from the other records alone, with what
happened: few filled marks lie to the left of 0.5, few open ones to the right. The bars are wide
where the object was near its limit. The tests are synthetic. See :doc:`/guides/calibration`.
"""

import matplotlib.pyplot as plt

import rocksteady as rs

column = rs.Block.rectangle(width=0.15, height=0.6)
tests = rs.calibration.make_synthetic_tests(
    column, rs.motions.make_synthetic_suite(6), model=rs.Linear()
)
calibration = rs.calibrate(tests, model=rs.Linear())
fig, ax = plt.subplots(figsize=(7.36, 5.0), layout="constrained")
rs.plots.predictions(calibration.validation.predictions, ax)
