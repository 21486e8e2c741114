"""What all kernels share: compilation, columns of the tables, the clock, the forcing."""
