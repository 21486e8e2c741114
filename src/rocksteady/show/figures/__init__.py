"""Whole figures of several plots, as the command line saves them."""
