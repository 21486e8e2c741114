"""
How do the channels of a station compare?
=========================================

Two horizontal channels and the vertical one at one scale, with the peak of each. These are
synthetic; ``rs.records.pair_records`` finds the channels of a station among files. See
:doc:`/guides/records`.
"""

import rocksteady as rs

kinds = ["east", "north", "up"]
scales = [1.0, 0.8, 0.4]
suite = rs.motions.make_synthetic_suite(3)
channels = [
    rs.Record(acceleration_m_s2=scale * each.acceleration_m_s2, dt_s=each.dt_s, name=kind)
    for kind, scale, each in zip(kinds, scales, suite, strict=True)
]
ax = rs.plots.channels(channels)
