"""Studies as folders: their finished parts, what is reported, and how they are written."""
