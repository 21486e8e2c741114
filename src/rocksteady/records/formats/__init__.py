"""How each file format is read: one module per format."""
