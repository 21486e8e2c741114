"""Whether the kernels of this installation compute what those of every other one do."""
