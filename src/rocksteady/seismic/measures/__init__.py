"""How strong a ground motion is: intensity measures, durations, elastic response spectra."""
