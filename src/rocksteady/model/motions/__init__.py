"""What shakes it: harmonic motion, pulses, impulses, records, and sums of them."""
