"""Which plots make up each figure that the command line saves."""
