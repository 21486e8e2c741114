"""How the probability of an event grows with intensity: curves, their likelihood, their bands."""
