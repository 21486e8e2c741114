"""Design spectra: tables of files, and the formulas of codes."""
