"""Build the wheels, one for each platform, and check the one of this machine."""
