"""Which attractor each initial state reaches, and how the safe basin erodes."""
