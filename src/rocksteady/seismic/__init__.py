"""What recorded ground motions do: intensity measures, elastic and rocking spectra."""
