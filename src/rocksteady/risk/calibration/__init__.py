"""Calibration: what follows from outcomes of tests for a block, and predictions of others."""
