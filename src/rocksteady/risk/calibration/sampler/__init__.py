"""The sampler: runs of draws, surfaces fitted to them, the likelihood of outcomes, proposals."""
