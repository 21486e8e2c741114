"""
At which scales does a record overturn a block?
===============================================

Each coloured piece is a range of factors at which a record overturns the block. The ranges have
gaps: a block that falls at one factor may stand at a larger one, so that one run at one factor
says little. See :doc:`/guides/spectra`.
"""

import rocksteady as rs

cabinet = rs.Block.rectangle(width=0.5, height=1.8)
suite = rs.motions.make_synthetic_suite(5)
scales = rs.find_overturning_scales(cabinet, suite, within=(1.0, 3.0), model=rs.Linear())
ax = rs.plots.overturning_scales(scales)
