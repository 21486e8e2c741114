"""What the block looks like in true scale, still or moving."""
