"""Plots of facades: the section of the wall, its capacity, and its runs under records."""
