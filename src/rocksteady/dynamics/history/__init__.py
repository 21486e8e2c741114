"""One time history: from a block, a base motion and a start to a trajectory."""
