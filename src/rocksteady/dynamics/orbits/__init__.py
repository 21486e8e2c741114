"""Which periodic orbits exist, and which attractor a motion settles to."""
