"""Motions of the block, built from the kernels: one, periodic ones, and all over a range."""
