"""How blocks of all sizes respond to recorded ground motions: rocking spectra."""
