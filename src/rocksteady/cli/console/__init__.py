"""What the program writes and where: streams, progress, files, refusals."""
