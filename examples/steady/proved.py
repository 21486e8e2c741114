"""
Where is the steady motion proved?
==================================

Boxes of frequency and amplitude in which the symmetric motion is proved to be stable, to be
unstable, or not to exist, in ball arithmetic. What is left undecided lies along the boundaries. See
:doc:`/how-to/prove`.
"""

import rocksteady as rs

region = rs.proofs.certify_region((0.3, 6.0), (1.0, 8.0), 0.8, most_boxes=20_000)
ax = rs.plots.proved_region(region)
ax.set_title(f"decided: {100.0 * region.decided:.1f} % of the area")
