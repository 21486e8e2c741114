"""How periodic orbits change with a parameter: branches and their bifurcations."""
