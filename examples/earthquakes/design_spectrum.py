"""
What do records look like on a design spectrum?
===============================================

Each has the peak acceleration of the spectrum, and is stretched in time until its own spectrum lies
there. The band holds the periods that decide whether a cabinet falls. See
:doc:`/how-to/design-spectrum`.
"""

import rocksteady as rs

placed = rs.motions.place_on_spectrum(
    rs.motions.make_synthetic_suite(28), "en1998-1:2004:type1:C:ag=0.25"
)
cabinet = rs.Block.rectangle(width=0.32, height=1.8)
rs.plots.placed_spectra(placed, block=cabinet)
