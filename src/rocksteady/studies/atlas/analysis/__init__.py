"""What is computed for the atlas: stable regions, coexisting motions, what follows from rest."""
