"""How results reach other programs: NetCDF, CSV and JSON files."""
