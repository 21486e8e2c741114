"""Ground-motion files: read, paired, and processed where it is asked for."""
