"""How each result is plotted: one function per result, on given axes or new ones."""
