"""Reading PTX, and writing each of its instructions in C."""
