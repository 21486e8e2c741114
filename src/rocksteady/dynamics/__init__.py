"""How blocks move: time histories, steady states, orbits, bifurcations, basins and overturning."""
