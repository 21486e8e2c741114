"""Proofs in ball arithmetic, their certificates, and the programs that check them alone."""
