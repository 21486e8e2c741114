"""Whole studies, each a folder: a published paper computed again, an atlas of rocking motions."""
