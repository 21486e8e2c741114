"""Which hazard, and what risk: hazard curves, annual rates of failure, balanced rocks."""
