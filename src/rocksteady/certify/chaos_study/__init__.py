"""Where motions of the block are proved to be chaotic, and with which entropy."""
