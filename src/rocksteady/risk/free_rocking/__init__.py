"""Restitution from measured free rocking."""
