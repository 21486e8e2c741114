"""Ground-motion files: readers of the formats that networks publish, one module a format."""
