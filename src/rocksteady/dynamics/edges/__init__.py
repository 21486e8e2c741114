"""Which states part basins: edge states, hilltop saddles, and manifolds of saddles."""
