"""Harmonic sweeps of symmetric blocks in the nonlinear model, in vector registers."""
