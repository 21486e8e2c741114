"""How strong a ground motion is: its course, durations, intensities, elastic spectra."""
