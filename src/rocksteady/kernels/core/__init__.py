"""What all kernels share: columns of tables, clock and forcing."""
