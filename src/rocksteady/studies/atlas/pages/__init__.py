"""What the atlas shows: its pictures, tables, sentences and page."""
