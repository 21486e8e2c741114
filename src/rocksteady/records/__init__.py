"""What a ground-motion file holds: its channels in SI units, paired and processed on request."""
