"""From an object to an answer: two numbers, an object file, a table of objects."""
