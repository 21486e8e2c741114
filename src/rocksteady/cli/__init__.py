"""The command line: parse, call, print.  No physics, and no heavy import before a command runs."""
