"""What all readers share: numbers, units, intervals, directions, and checks of them."""
