"""Which pulses overturn a block, and how it rocks freely."""
