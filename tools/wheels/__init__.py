"""Build the wheels, one for each platform and one for GPUs, and check the one of this machine."""
