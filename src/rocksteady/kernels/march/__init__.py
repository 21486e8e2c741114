"""One motion: flights strung together by impacts, rests and the segments of the base motion."""
