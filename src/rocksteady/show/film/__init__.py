"""The block in true scale, still or moving."""
