"""Recorded calls repeated on every target that runs here, whatever processor it is for."""
