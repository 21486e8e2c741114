"""What all readers share: numbers, units, sampling, directions, and their checks."""
