"""Which flags exist, and which blocks, motions and axes they become."""
