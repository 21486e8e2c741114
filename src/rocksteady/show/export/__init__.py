"""Results as files for other programs: NetCDF, CSV, JSON; whole or not there."""
