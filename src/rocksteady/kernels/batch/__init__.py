"""One call for many cases: a loop over cells for each kind of shaking."""
