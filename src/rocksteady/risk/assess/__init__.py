"""Assessment of objects: by two numbers, by an object file, by a table; remedies."""
