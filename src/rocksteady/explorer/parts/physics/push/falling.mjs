// Runs that follow a fall until the block lies on the ground, as far as the equations go.

import { GRAVITY, sidesOf } from '../case.mjs';
import { baseCourse } from '../demand/run.mjs';
import { harmonicTable, pulseTable, recordTable } from '../motions.mjs';
import { firstRows, flightsAt, runOf, statesAt } from '../run.mjs';
import { beginOf } from '../start.mjs';

/** @import { Floats, Kernels } from '../../kernels/loader.mjs' */
/** @import { GroundMotion } from '../motions.mjs' */
/** @import { RecordBlock } from '../quake/record.mjs' */
/** @import { How, Run } from '../run.mjs' */

/**
 * A run as a film shows it; times in seconds from its start.
 * @typedef {object} Reel
 * @property {RecordBlock} block
 * @property {number} step  between the samples
 * @property {Float64Array} angle  theta/alpha, up to the end of the film
 * @property {Float64Array} velocity  du/d(pt)
 * @property {boolean} falls
 * @property {number | null} overturns  when it passes alpha for the last time
 * @property {number} peak  largest |theta|/alpha up to then
 * @property {{ time: Float64Array, side: Float64Array, speed: Float64Array }} impacts  du/d(pt)
 */

const CEILING = 7; // columns of segments (kernels/core/tables.py)
export const REEL_STEP = 1 / 120; // [s]

/**
 * Return the first rows of a table, of which nothing is known that may follow: a march along them
 * ends with them, or where the block lies on its side.
 * @param {Floats} table
 * @param {number} rows
 */
export function openEnded(table, rows) {
  const columns = table.shape[1], { values } = table;
  for (let row = 0; row < rows; row++) values[row * columns + CEILING] = Infinity;
  return firstRows(table, rows);
}

/**
 * Return the film of a run for some seconds.  The table's last row, if it is endless, is cut there.
 * @param {Kernels} kernels
 * @param {RecordBlock} block
 * @param {Floats} table  freed
 * @param {number} seconds
 * @param {How} [how]
 * @returns {Reel}
 */
export function reelOf(kernels, block, table, seconds, how = {}) {
  const { p } = block, [rows, columns] = table.shape, { values } = table;
  let known = 0;
  for (let row = 0; row < rows - 1; row++) known += values[row * columns];
  const last = (rows - 1) * columns, left = Math.max(seconds * p - known, REEL_STEP * p);
  if (values[last] === Infinity) values[last] = left;
  const sides = sidesOf(kernels, { ...block, amplitude: 0, frequencyRatio: 0 });
  const tables = { segments: openEnded(table, rows), sides };
  const run = runOf(kernels, tables, how);
  const reel = filmed(kernels, block, run, seconds);
  table.free();
  sides.free();
  return reel;
}

/**
 * @param {Kernels} kernels
 * @param {RecordBlock} block
 * @param {Run} run
 * @param {number} seconds
 * @returns {Reel}
 */
function filmed(kernels, block, run, seconds) {
  const { p, alpha } = block;
  const times = reelTimes(seconds, p);
  const reached = times.findIndex((time) => time > run.end);
  const count = reached < 0 ? times.length : reached;
  const states = statesAt(kernels, run.tables, run.rows, flightsAt(run.starts, times.subarray(0, count)));
  const [angle, velocity] = [0, count].map((from) => {
    const held = new Float64Array(times.length).fill(states[from + count - 1] || 0);
    held.set(states.subarray(from, from + count));
    return held;
  });
  // The linear model goes on past the ground.
  const flat = (0.5 * Math.PI) / alpha, beyond = angle.findIndex((here) => Math.abs(here) >= flat);
  const falls = run.status === 'overturned' || beyond >= 0, down = beyond < 0 ? count : beyond;
  if (falls && down) {
    angle.fill(Math.sign(angle[down - 1]) * flat, down);
    velocity.fill(0, down);
  }
  const { time, side, before } = run.impacts;
  const seconded = (/** @type {number} */ at) => at / p;
  return {
    block, step: REEL_STEP, angle, velocity, falls,
    overturns: run.overturned === null ? null : run.overturned / p,
    peak: Math.max(run.peaks[0], run.peaks[1]),
    impacts: { time: time.map(seconded), side, speed: before.map(Math.abs) },
  };
}

/**
 * A block under a pulse, harmonic shaking or a motion: at rest, or let go from a state.
 * @typedef {object} FilmAsked
 * @property {RecordBlock} block
 * @property {number} seconds
 * @property {{ shape: string, amplitude: number, ratio: number }} [pulse]
 * @property {{ amplitude: number, ratio: number }} [harmonic]
 * @property {GroundMotion} [motion]
 * @property {{ angle: number, velocity: number }} [start]  theta/alpha and du/d(pt)
 */

/**
 * Film a block, with the accelerations of its base over alpha g: a job of the pool.
 * @param {Kernels} kernels
 * @param {FilmAsked} asked
 * @returns {Reel & { base: Float64Array }}
 */
export function baseReel(kernels, { block, seconds, pulse, harmonic, motion, start }) {
  const { nonlinear, p, alpha } = block;
  const table = motion ? recordTable(kernels, motion, nonlinear, p, alpha * GRAVITY)
    : pulse ? pulseTable(kernels, pulse.shape, pulse.amplitude, pulse.ratio, { nonlinear })
      : harmonicTable(kernels, {
        amplitude: harmonic?.amplitude ?? 0, frequencyRatio: harmonic?.ratio ?? 1, nonlinear,
      });
  const [rows, columns] = table.shape, starts = new Float64Array(rows);
  for (let row = 1; row < rows; row++) starts[row] = starts[row - 1] + table.values[(row - 1) * columns];
  const base = baseCourse(kernels, table, starts, reelTimes(seconds, p));
  const still = { amplitude: 0, frequencyRatio: 1, ...block };
  const march = start && beginOf(kernels, still, { kind: 'state', ...start }).march;
  return { ...reelOf(kernels, block, table, seconds, { start: march }), base };
}

/** @param {number} seconds @param {number} p */
function reelTimes(seconds, p) {
  return Float64Array.from({ length: Math.ceil(seconds / REEL_STEP) + 1 }, (_, k) => k * REEL_STEP * p);
}

/**
 * Return theta/alpha at a time, along lines between the samples of a film.
 * @param {Reel} reel
 * @param {number} time  [s]
 */
export function reelAngle({ angle, step }, time) {
  const at = Math.min(Math.max(time / step, 0), angle.length - 1), k = Math.floor(at);
  const next = angle[Math.min(k + 1, angle.length - 1)];
  return angle[k] + (at - k) * (next - angle[k]);
}
