"""One motion: flights joined by impacts, rests and the segments of the base motion."""
