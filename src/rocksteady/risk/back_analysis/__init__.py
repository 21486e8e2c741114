"""Back-analysis: which shaking agrees with what fell and what stood."""
