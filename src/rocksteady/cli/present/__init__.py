"""How each result is printed: values for JSON, tables, lines of text."""
