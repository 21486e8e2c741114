"""Which values are accepted, and what is said of the others: types, shapes, ranges."""
