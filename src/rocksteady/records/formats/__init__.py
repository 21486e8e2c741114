"""One reader a file format: from a file's text to its recordings."""
