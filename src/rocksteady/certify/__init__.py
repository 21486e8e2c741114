"""Proofs in ball arithmetic: certificates, their checkers, a picture and a study of chaos."""
