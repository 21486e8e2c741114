"""What rocks: a block in metres or without dimensions, with sides that may differ."""
