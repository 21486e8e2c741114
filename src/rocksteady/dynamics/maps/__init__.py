"""Which attractor or fate each point of a grid of parameters has."""
