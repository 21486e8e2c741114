"""Make what a release needs beside wheels: sources, metadata, recipe, bill of materials."""
