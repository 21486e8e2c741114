"""Compile the kernels ahead of time: lower them once, then build a library for each target."""
