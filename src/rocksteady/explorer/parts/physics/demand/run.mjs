// A block that stands at rest when its base begins to move: its run, and its states and the
// acceleration of the base at some times.
import { evaluateEach } from '../case.mjs';
import { FLIGHT_COLUMNS, FLIGHT_SIDE, flightsAt, runOf, statesAt } from '../run.mjs';

/** @import { Floats, Kernels, Tables } from '../../kernels/loader.mjs' */
/** @import { How } from '../run.mjs' */

/**
 * A run from rest, with its states at some times.  Times are pivot times, angles theta/alpha.
 * @typedef {object} SampledRun
 * @property {string} status  rocking, at rest, overturned, lost contact, undecided
 * @property {number} peak  largest |theta|/alpha, until it overturns
 * @property {number} side  on which it falls, or 0
 * @property {number} end  up to which the run reaches
 * @property {number | null} overturns  when it passes theta = alpha for the last time
 * @property {number} flights
 * @property {Float64Array} impacts  times of those that leave with COUNTED or more
 * @property {Float64Array} impactSpeeds  du/d(pt) before each
 * @property {Float64Array} begins  of the flights
 * @property {Float64Array} starts  of the segments
 * @property {number | null} rests
 * @property {Float64Array} times
 * @property {Float64Array} states  at them: angles, then velocities, then accelerations
 * @property {Float64Array} base  a/(alpha g)
 */

const DENSE = 120; // samples while the base moves

/**
 * Follow a block from rest.
 * @param {Kernels} kernels
 * @param {Tables} tables  the base, with an endless last segment, and the block
 * @param {How & { samples?: number, until?: number }} how  samples: even times at which its state
 *   is wanted, up to until (or to where pictures follow the run)
 * @returns {SampledRun}
 */
export function runFromRest(kernels, tables, { samples = 0, until, ...how }) {
  const { segments } = tables, [count, columns] = segments.shape, table = segments.values;
  const endless = table[(count - 1) * columns + 5] !== 0;
  const starts = new Float64Array(count);
  for (let k = 1; k < count; k += 1) starts[k] = starts[k - 1] + table[(k - 1) * columns];
  const run = runOf(kernels, tables, how), moving = starts[count - 1];
  const { end, flights, rested, rows } = run, begins = run.starts;
  const shown = endless || rested === null ? end : Math.min(end, Math.max(1.05 * rested, moving) + 0.1);
  const times = sampledTimes(Math.min(until ?? shown, shown, end), samples, begins, moving);
  return {
    status: run.status.replace('-', ' '), peak: Math.max(run.peaks[0], run.peaks[1]),
    side: run.overturned === null ? 0 : rows.values[(flights - 1) * FLIGHT_COLUMNS + FLIGHT_SIDE],
    end, overturns: run.overturned, flights, impacts: run.impacts.time,
    impactSpeeds: run.impacts.before, begins, starts, rests: rested, times,
    states: statesAt(kernels, tables, rows, flightsAt(begins, times)),
    base: baseCourse(kernels, segments, starts, times),
  };
}

/**
 * Return times in order: evenly spaced up to an end, the starts of flights, and more of them while
 * the base moves, because a short pulse has samples of its own.
 * @param {number} end
 * @param {number} samples  of the evenly spaced ones; none for no times at all
 * @param {Float64Array} begins
 * @param {number} moving
 * @returns {Float64Array}
 */
function sampledTimes(end, samples, begins, moving) {
  if (!samples) return new Float64Array(0);
  const even = Array.from({ length: samples + 1 }, (_, k) => k < samples ? (end / samples) * k : end);
  const dense = Array.from({ length: DENSE }, (_, k) => (moving / DENSE) * (k + 1));
  return Float64Array.from(
    [...even, ...[...begins, ...dense].filter((at) => at > 0 && at < end)]).sort();
}

/**
 * Return base accelerations at pivot times, over alpha g.
 * @param {Kernels} kernels
 * @param {Floats} segments
 * @param {Float64Array} starts  of the segments
 * @param {ArrayLike<number>} times  ascending
 * @returns {Float64Array}
 */
export function baseCourse(kernels, segments, starts, times) {
  const columns = segments.shape[1], table = segments.values;
  const value = new Float64Array(times.length), turned = new Float64Array(times.length);
  const size = new Float64Array(times.length);
  for (let k = 0, index = 0; k < times.length; k += 1) {
    while (index + 1 < starts.length && starts[index + 1] <= times[k]) index += 1;
    const at = index * columns, since = times[k] - starts[index];
    value[k] = table[at + 2] + table[at + 3] * since;
    size[k] = table[at + 4];
    turned[k] = table[at + 5] * since + table[at + 6];
  }
  const sine = evaluateEach(kernels, 'sin', turned);
  return value.map((constant, k) => constant + size[k] * sine[k]);
}
