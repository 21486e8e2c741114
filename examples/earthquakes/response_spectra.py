"""
How do the records of a suite differ?
=====================================

The elastic response spectra of twelve synthetic records, and their geometric mean. They say little
about a block, which has no period of its own: the higher it rises, the longer it swings. Rocking
spectra answer for blocks. See :doc:`/guides/measures`.
"""

import numpy as np

import rocksteady as rs

periods = np.geomspace(0.05, 5.0, 150)
suite = rs.motions.make_synthetic_suite(12)
ax = rs.plots.response_spectra(
    [rs.measures.compute_response_spectrum(each, periods) for each in suite]
)
ax.set_title("Response spectra of 12 synthetic records, damping 5 %")
