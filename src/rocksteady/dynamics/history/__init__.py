"""How one block moves in time: from block, base motion and start to trajectory."""
