"""What is printed of a result: plain values, tables, rows."""
