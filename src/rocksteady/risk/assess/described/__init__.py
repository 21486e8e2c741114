"""Object files (TOML) and tables of objects (CSV): keys, checks, derived properties."""
