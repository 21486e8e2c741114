"""Checks of a facade on paper and on disk, in English and Italian."""
