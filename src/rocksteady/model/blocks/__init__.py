"""What rocks: a block in metres or dimensionless, with equal or different sides."""
