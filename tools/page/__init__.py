"""Checks of the explorer's page that need other programs than Python."""
