"""Which motions a block has over the plane of frequency and amplitude, for one restitution."""
