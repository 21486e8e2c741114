"""What all kernels share: compilation, columns of tables, clock, forcing, sine and cosine."""
