"""What shakes the block: harmonic motion, pulses, impulses, records, and their sums."""
