"""Compile the kernels ahead of time: lower them once, then optimise, emit and link for each target."""
