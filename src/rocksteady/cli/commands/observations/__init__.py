"""Commands on what fell and what stood: calibrate, predict, back-analyse, restitution."""
