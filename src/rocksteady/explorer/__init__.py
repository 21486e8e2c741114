"""The explorer: one HTML page with the kernels inside, which computes while it is touched."""
