"""Which pulses overturn a block, and how a block rocks freely."""
