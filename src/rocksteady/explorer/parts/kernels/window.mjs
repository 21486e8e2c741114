// Made by `python -m tools.aot.web` from the basins in Python.

/** Angle in units of alpha, velocity of alpha p, on either side. */
export const START_WINDOW = { angle: 1.2, velocity: 1.5, columns: 144, rows: 108, cycles: 500 };
