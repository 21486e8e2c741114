"""What arrays of initial states settle to, and how their motions end."""
