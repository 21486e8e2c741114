"""How the atlas is shown: its pictures, tables, sentences and page."""
