"""Files that a person has written or named: tables in CSV, TOML, records in a folder."""
