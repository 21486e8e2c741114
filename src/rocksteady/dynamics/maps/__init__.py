"""Attractors and fates over a grid of parameters of block, shaking and start."""
