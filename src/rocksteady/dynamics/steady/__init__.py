"""Symmetric steady states in closed form, and where in the plane of parameters they exist."""
