"""Which values are accepted, and how others are refused: types, shapes, ranges."""
