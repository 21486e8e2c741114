"""What ground motions are worth: their course, intensity measures and response spectra."""
