"""Calibration: what outcomes of tests say of a block, and predictions of others."""
