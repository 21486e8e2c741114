"""
Is Housner's restitution right?
===============================

Left, restitutions measured at the first impact of limestone blocks: the two most slender ones lose
more velocity than Housner's formula has it. Right, the decay of one of them, if every impact took
as much as the mean first one; counted decays differ from both. Data of a public archive,
https://doi.org/10.60756/uminho-jh25 (CC BY). See :doc:`/guides/restitution`.
"""

import matplotlib.pyplot as plt
import numpy as np

import rocksteady as rs

slender = np.arange(4, 16)  # height over width
means = [0.9401, 0.9397, 0.9319, 0.9616, 0.9539, 0.9729]
means += [0.9827, 0.9677, 0.9960, 0.9964, 0.9466, 0.9712]
housner = [rs.formulas.housner_restitution(alpha) for alpha in np.arctan(1.0 / slender)]
fig, (left, right) = plt.subplots(1, 2, figsize=(7.36, 3.8), layout="constrained")
left.plot(slender, housner, "C4--", label="Housner")
left.errorbar(slender, means, 0.034, fmt="C4o", elinewidth=0.8, label="mean of tests, ± 1 sd")
left.set(xlabel="height over width", ylabel="restitution of the first impact")
for e, look, name in ((means[10], "C0", "first impacts"), (housner[10], "C4--", "Housner")):
    right.plot(rs.formulas.free_rocking_peaks(0.5, e, 120), look)
    right.text(*((22, 0.1) if look == "C0" else (45, 0.26)), name, color=look[:2])
right.set(xlabel="impacts", ylabel="peak  θ/α", ylim=(0.0, 0.52), title="height over width 14")
left.legend(loc="lower right")
