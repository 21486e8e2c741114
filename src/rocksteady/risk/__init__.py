"""Whether an object falls: ensembles, fragility, code screens, hazard and risk."""
