"""The command line: parses flags, calls the package and prints the result, without any physics.

No heavy package is imported before a command runs.
"""
