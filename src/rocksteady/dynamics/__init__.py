"""Motions of the block: time histories and steady states, built from the kernels."""
