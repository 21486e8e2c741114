"""From an object to an answer: whether it falls."""
