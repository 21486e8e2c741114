"""From counted runs to an answer: motions with the demand's peaks, shares, bands, verdicts."""
