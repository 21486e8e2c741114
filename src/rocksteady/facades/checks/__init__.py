"""Facades, parapets and gables: checks of Circolare 2019 n. 7, static and dynamic."""
