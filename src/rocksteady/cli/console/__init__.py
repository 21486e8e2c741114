"""What the program writes, and where: terminal, progress, files, error lines."""
