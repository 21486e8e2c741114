"""Every figure of the paper, computed again: its data, its words and its picture."""
