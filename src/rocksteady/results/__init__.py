"""What every result can do: describe itself, and be rendered as text, HTML, JSON and rows."""
