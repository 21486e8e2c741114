"""Many motions at once: initial states, what they settle to, and how they end."""
