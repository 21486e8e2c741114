"""One plot a result: takes it and, optionally, axes; draws; returns the axes."""
