"""What others' calculations say of blocks on real records: full equations, no vertical motion.

A record's acceleration is in g and a block is its p and alpha, so that the value of g has no part.
"""

import math

PEAKS = [
    ("PUL164", 2.0 * math.pi / 4.0, math.radians(15.0), 0.1249485),
    ("PUL164", 2.0 * math.pi / 6.0, math.radians(15.0), 0.0488996),
    ("PUL164", 2.0, math.radians(20.0), 0.0740432),
    ("PUL164", 2.0 * math.pi / 7.0, math.radians(20.0), 0.0120907),
    ("PUL164", 2.0 * math.pi / 6.0, math.radians(10.0), 0.0987082),
    ("ELC180", 2.0, 0.15, 0.0450117),
    ("ELC180", 3.0, 0.2, 0.110971),
    ("CLS000", 2.0, 0.15, 0.1083426),
    ("CLS000", 2.157, 0.3217, 0.0451242),
]
"""Part of the name of the record's file, p [rad/s], alpha [rad], largest |theta| [rad]."""

AT_PACOIMA_DAM = [(10.0, 4.25, True), (10.0, 4.5, False), (20.0, 2.0, True), (20.0, 2.5, False)]
"""On PUL164: alpha [degrees], 2 pi/p [s], whether the block overturns."""
