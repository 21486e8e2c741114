"""Where the initial states of a window go, and how the safe basin erodes."""
