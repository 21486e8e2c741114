"""Calls of every kernel that Python calls, recorded so that each target can repeat them."""
