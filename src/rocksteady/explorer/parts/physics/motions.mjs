// Base motions as tables of segments, the same bits as in Python.

import { PULSES } from '../kernels/pulses.mjs';

/** @import { Floats, Kernels } from '../kernels/loader.mjs' */

/**
 * Recorded acceleration, straight between the samples, then a still base.
 * @typedef {object} GroundMotion
 * @property {Float64Array} samples  [m/s2]
 * @property {number} dt  [s]
 */

export const PULSE_TOLERANCE = 1e-6; // of the lines along a wavelet, as a part of its amplitude
const SEGMENT_COLUMNS = { linear: 9, nonlinear: 12 };
const CEILING = 7;

/**
 * Return a table of zeros; free it.
 * @param {Kernels} kernels
 * @param {number} rows
 * @param {boolean} nonlinear
 */
function emptyTable(kernels, rows, nonlinear) {
  const columns = nonlinear ? SEGMENT_COLUMNS.nonlinear : SEGMENT_COLUMNS.linear;
  return kernels.array('f', [rows, columns]);
}

/**
 * Return the table of endless harmonic shaking; free it.
 * @param {Kernels} kernels
 * @param {{ amplitude: number, frequencyRatio: number, nonlinear: boolean }} given
 * @param {number} [phase]  at the start [rad]
 * @returns {Floats}
 */
export function harmonicTable(kernels, { amplitude, frequencyRatio, nonlinear }, phase = 0) {
  const table = emptyTable(kernels, 1, nonlinear);
  kernels.harmonic_segment(table, amplitude, frequencyRatio, phase);
  return table;
}

/**
 * Return the table of a pulse; free it.
 * @param {Kernels} kernels
 * @param {string} shape  one of PULSES
 * @param {number} amplitude  largest acceleration over alpha g
 * @param {number} ratio  omega/p
 * @param {{ nonlinear: boolean, still?: boolean, ceiling?: boolean, tolerance?: number }} how
 *   still: whether a still base follows; ceiling false: infinite ones, as a search for windows has
 *   them; tolerance: PULSE_TOLERANCE or 1e-4
 * @returns {Floats}
 */
export function pulseTable(kernels, shape, amplitude, ratio, how) {
  const { nonlinear, still = true, ceiling = true, tolerance = PULSE_TOLERANCE } = how;
  const { pieces, reach, ...numbers } = PULSES[shape];
  const given = kernels.array('f', [pieces.length, 6], pieces.flat());
  const pulse = {
    ...numbers, pieces: given, reach: reach[tolerance] ?? 0, amplitude, frequency_ratio: ratio, tolerance,
  };
  const none = emptyTable(kernels, 0, nonlinear), [count] = kernels.fill_pulse(pulse, none);
  const table = emptyTable(kernels, count + Number(still), nonlinear), columns = table.shape[1];
  kernels.fill_pulse(pulse, table);
  if (still) table.values[count * columns] = Infinity;
  kernels.fill_bounds(table);
  for (let row = 0; row < count && !ceiling; row += 1) table.values[row * columns + CEILING] = Infinity;
  given.free();
  none.free();
  return table;
}

/**
 * Return the table of a motion, with the still base after it; free it.
 * @param {Kernels} kernels
 * @param {GroundMotion} motion
 * @param {boolean} nonlinear
 * @param {number} [rate]  p [rad/s], the unit of time
 * @param {number} [unit]  alpha g [m/s2], the unit of acceleration
 * @returns {Floats}
 */
export function recordTable(kernels, { samples, dt }, nonlinear, rate = 1, unit = 1) {
  const given = kernels.array('f', [samples.length], samples.map((value) => value / unit));
  const table = emptyTable(kernels, samples.length, nonlinear);
  kernels.fill_lines(given, dt * rate, table);
  given.free();
  return table;
}

/**
 * Return a motion times a factor.
 * @param {GroundMotion} motion
 * @param {number} factor
 * @returns {GroundMotion}
 */
export function scaledMotion({ samples, dt }, factor) {
  return { dt, samples: samples.map((value) => factor * value) };
}
