"""Commands over windows of initial states: basins, fates and their edges."""
