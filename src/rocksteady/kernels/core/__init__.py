"""What all kernels share: columns of tables, clock, forcing, sine and cosine."""
