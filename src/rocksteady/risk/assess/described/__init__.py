"""An object as its owner describes it: a file or a line of a table, checked, and what follows."""
