"""Observations: which blocks fell and which stood, what is known of them before, and their fates."""
