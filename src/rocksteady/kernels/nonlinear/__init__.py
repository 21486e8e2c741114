"""One flight of the nonlinear model: its Taylor series, first zero, proofs and derivatives."""
