"""Observations: which blocks fell and which stood, what is known of them, and their fates."""
