"""Published formulas side by side: uplift, ASCE 43-05, Ishiyama, FEMA P-58 and others."""
