"""Sweeps on an NVIDIA GPU: the executor, the launch of kernels, and their compiled programs."""
