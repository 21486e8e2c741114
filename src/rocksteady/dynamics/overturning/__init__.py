"""Overturning by a pulse: the windows of amplitude in which a block falls, and closed forms."""
