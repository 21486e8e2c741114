// A block that stands at rest when its base begins to move: one run with all its flights, the same
// bits as `simulate` and `Trajectory` in Python.
import { COUNTED, evaluate } from '../case.mjs';
import { evaluateEach } from './shapes.mjs';

/** @import { Floats, Kernels, March } from '../../kernels/loader.mjs' */

/**
 * A run from rest.  Times are pivot times, angles theta/alpha.
 * @typedef {object} RestRun
 * @property {string} status  rocking, at rest, overturned, undecided
 * @property {number} peak  largest |theta|/alpha, until it overturns
 * @property {number} side  on which it falls, or 0
 * @property {number} end  up to which the run reaches
 * @property {number | null} overturns  when it passes theta = alpha for the last time
 * @property {number | null} rests
 * @property {number} flights
 * @property {Float64Array} impacts  times of those that leave with COUNTED or more
 * @property {Float64Array} impactSpeeds  du/d(pt) before each
 */

/**
 * A run with its states at some times.
 * @typedef {RestRun & { times: Float64Array, states: Float64Array, base: Float64Array,
 *   begins: Float64Array, starts: Float64Array }} SampledRun
 *   states: angles, then velocities, then accelerations; base: a/(alpha g); begins, starts: of the
 *   flights and of the segments
 */

export const REST_RUN_STATUS = ['rocking', 'at rest', 'overturned', 'lost contact', 'undecided'];
const REST_RUN_LONGEST = { lossy: 1e15, elastic: 1e4 };
const REST_RUN_ROW = {
  segment: 0, halves: 1, phase: 2, side: 3, angle: 4, velocity: 5, duration: 6, event: 7, columns: 8,
};
const REST_RUN_RESTED = 1, REST_RUN_OVERTURNED = 2, REST_RUN_IMPACT = 1;
const REST_RUN_SMALLEST_BOUNCE = 1e-8;
const REST_RUN_DENSE = 120;
const REST_RUN_SHOWN_TO = 2; // theta/alpha up to which a fall is followed

/**
 * Return the march of a block from rest, as a function of what it records.
 * @param {Kernels} kernels
 * @param {Floats} segments
 * @param {Floats} sides
 * @param {{ cycles?: number, most?: number }} how
 * @returns {(rows: Floats, peaks: Floats) => [number, March]}
 */
function marchFromRest(kernels, segments, sides, { cycles, most = 4e6 }) {
  const columns = segments.shape[1], count = segments.shape[0];
  const table = segments.values, block = sides.values;
  const lossless = block[0] === 1 && block[sides.shape[1]] === 1;
  const [half, phase] = table[5] ? kernels.clock(table[6]) : [0, 0];
  let stopHalf = 0, stopPhase = lossless ? REST_RUN_LONGEST.elastic : REST_RUN_LONGEST.lossy;
  if (table[(count - 1) * columns + 5] !== 0) {
    const periods = cycles ?? 50, halves = Math.floor(2 * periods);
    const [firstHalf, firstPhase] = kernels.segment_start(segments, 0);
    stopHalf = firstHalf + halves;
    stopPhase = firstPhase + (2 * periods - halves) * Math.PI;
    if (stopPhase >= Math.PI) [stopHalf, stopPhase] = [stopHalf + 1, stopPhase - Math.PI];
  }
  const start = {
    side: 0, angle: 0, velocity: 0, segment: 0, half_cycles: half, phase, impacts: 0, flights: 0,
  };
  const until = {
    half_cycles: stopHalf, phase: stopPhase, rest_velocity: REST_RUN_SMALLEST_BOUNCE, limit: most,
  };
  return (rows, peaks) => kernels.march({ segments, sides }, start, until, { rows, peaks });
}

/**
 * Return how a run from rest ends, and the largest |theta|/alpha of one that does not overturn.
 * @param {Kernels} kernels
 * @param {Floats} segments
 * @param {Floats} sides
 * @param {{ cycles?: number, most?: number }} how
 * @returns {{ status: string, peak: number }}
 */
export function fateFromRest(kernels, segments, sides, how) {
  const none = kernels.array('f', [0, REST_RUN_ROW.columns]), peaks = kernels.array('f', [2]);
  const [code] = marchFromRest(kernels, segments, sides, how)(none, peaks);
  const [peak] = peaks.values;
  none.free();
  peaks.free();
  return { status: REST_RUN_STATUS[code], peak };
}

/**
 * Follow a block from rest.
 * @param {Kernels} kernels
 * @param {Floats} segments  the base, with an endless last segment
 * @param {Floats} sides
 * @param {{ cycles?: number, most?: number, samples?: number, until?: number }} how  cycles: of
 *   endless harmonic shaking; most: flights; samples: even times at which its state is wanted, up
 *   to until (or to where pictures follow the run)
 * @returns {SampledRun}
 */
export function runFromRest(kernels, segments, sides, how) {
  const { samples = 0, until } = how, columns = segments.shape[1];
  const endless = segments.values[(segments.shape[0] - 1) * columns + 5] !== 0;
  const march = marchFromRest(kernels, segments, sides, how);
  const none = kernels.array('f', [0, REST_RUN_ROW.columns]), nothing = kernels.array('f', [0]);
  const [, ended] = march(none, nothing);
  const rows = kernels.array('f', [ended.flights, REST_RUN_ROW.columns]);
  const [code] = march(rows, nothing);
  const run = measuredRest(kernels, segments, sides, rows, code);
  const sampled = sampledRest(kernels, segments, sides, rows, run, endless, samples, until);
  for (const array of [none, nothing, rows]) array.free();
  return { ...run, ...sampled };
}

/**
 * Return pivot times at which segments and flights begin.
 * @param {Kernels} kernels
 * @param {Floats} segments
 * @param {Floats} rows
 * @returns {{ starts: Float64Array, begins: Float64Array }}
 */
function restBegins(kernels, segments, rows) {
  const columns = segments.shape[1], table = segments.values, flights = rows.values;
  const starts = new Float64Array(segments.shape[0]);
  for (let k = 1; k < starts.length; k += 1) starts[k] = starts[k - 1] + table[(k - 1) * columns];
  /** @type {Map<number, [number, number]>} */
  const clocks = new Map();
  const begins = new Float64Array(rows.shape[0]);
  let latest = -Infinity;
  for (let k = 0; k < begins.length; k += 1) {
    const at = k * REST_RUN_ROW.columns, index = flights[at + REST_RUN_ROW.segment];
    const frequency = table[index * columns + 5];
    let since = flights[at + REST_RUN_ROW.phase];
    if (frequency) {
      const first = clocks.get(index) ?? kernels.segment_start(segments, index);
      clocks.set(index, first);
      const halves = flights[at + REST_RUN_ROW.halves] - first[0];
      since = (halves * Math.PI + (since - first[1])) / frequency;
    }
    latest = Math.max(latest, starts[index] + since);
    begins[k] = latest;
  }
  return { starts, begins };
}

/**
 * @param {Kernels} kernels
 * @param {Floats} segments
 * @param {Floats} sides
 * @param {Floats} rows
 * @param {number} code
 * @returns {RestRun & { begins: Float64Array, starts: Float64Array }}
 */
function measuredRest(kernels, segments, sides, rows, code) {
  const { starts, begins } = restBegins(kernels, segments, rows);
  const flights = rows.values, block = sides.values, last = rows.shape[0] - 1;
  const at = last * REST_RUN_ROW.columns, fell = code === REST_RUN_OVERTURNED;
  let duration = flights[at + REST_RUN_ROW.duration];
  if (fell && duration === Infinity) {
    const tilt = Math.abs(flights[at + REST_RUN_ROW.angle]) / block[1];
    let level = Math.max(REST_RUN_SHOWN_TO, 1 + tilt);
    if (kernels.is_nonlinear(sides)) level = Math.min(level, (0.5 * Math.PI) / block[3]);
    const [row, since] = kernels.last_crossing(segments, sides, rows, level);
    duration = row === last ? since : 0;
  }
  let overturns = null;
  if (fell) {
    const [row, since] = kernels.last_crossing(segments, sides, rows, 1);
    overturns = begins[row] + since;
  }
  const peaks = fell ? kernels.peaks_until_overturning(segments, sides, rows)
    : kernels.recorded_peaks(segments, sides, rows, duration);
  /** @type {number[]} */
  const ended = [];
  for (let k = 0; k <= last; k += 1) {
    if (flights[k * REST_RUN_ROW.columns + REST_RUN_ROW.event] === REST_RUN_IMPACT) ended.push(k);
  }
  const landed = restStates(kernels, segments, sides, rows, ended,
    ended.map((k) => rows.values[k * REST_RUN_ROW.columns + REST_RUN_ROW.duration]));
  const speeds = landed.slice(ended.length, 2 * ended.length), ratio = sides.values[0];
  const counts = (/** @type {number} */ _, /** @type {number} */ k) =>
    Math.abs(ratio * speeds[k]) >= COUNTED;
  const impacts = Float64Array.from(ended, (k) => k < last ? begins[k + 1]
    : begins[k] + rows.values[k * REST_RUN_ROW.columns + REST_RUN_ROW.duration]).filter(counts);
  const run = {
    status: REST_RUN_STATUS[code], peak: Math.max(peaks[0], peaks[1]),
    side: fell ? rows.values[at + REST_RUN_ROW.side] : 0, end: begins[last] + duration, overturns,
    flights: last + 1, impacts, impactSpeeds: speeds.filter(counts), begins, starts,
  };
  const rests = code === REST_RUN_RESTED
    ? restSince(kernels, segments, sides, rows, run, speeds[speeds.length - 1]) : null;
  return { ...run, rests };
}

/**
 * Return when a block came to rest where it stayed, the bounces still to come included.
 * @param {Kernels} kernels
 * @param {Floats} segments
 * @param {Floats} sides
 * @param {Floats} rows
 * @param {{ begins: Float64Array, starts: Float64Array }} run
 * @param {number} landed  du/d(pt) before the last impact, however slow
 * @returns {number}
 */
function restSince(kernels, segments, sides, rows, { begins, starts }, landed) {
  const flights = rows.values;
  let first = rows.shape[0];
  while (first > 0 && flights[(first - 1) * REST_RUN_ROW.columns + REST_RUN_ROW.side] === 0) first -= 1;
  const before = (first - 1) * REST_RUN_ROW.columns, start = begins[first];
  if (first === 0 || flights[before + REST_RUN_ROW.event] !== REST_RUN_IMPACT) return start;
  const side = flights[before + REST_RUN_ROW.side], ratio = sides.values[0];
  const velocity = Math.abs(ratio * landed);
  const towards = -side * restAcceleration(kernels, segments, starts, start);
  let own = 1, share = 1;
  if (kernels.is_nonlinear(sides)) {
    const alpha = sides.values[3];
    own = evaluate(kernels, 'sin', alpha) / alpha;
    share = evaluate(kernels, 'cos', alpha);
  }
  const near = own - towards * share, far = own - -towards * share;
  const lost = (1 - ratio) * (1 + ratio) + (ratio - ratio);
  return start + 2 * velocity * (1 / near + ratio / far) / lost;
}

/**
 * Return the base acceleration at a pivot time, over alpha g.
 * @param {Kernels} kernels
 * @param {Floats} segments
 * @param {Float64Array} starts
 * @param {number} time
 * @returns {number}
 */
function restAcceleration(kernels, segments, starts, time) {
  return baseCourse(kernels, segments, starts, [time])[0];
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

/**
 * Return angles, velocities and accelerations at times since the start of rows.
 * @param {Kernels} kernels
 * @param {Floats} segments
 * @param {Floats} sides
 * @param {Floats} rows
 * @param {number[]} index
 * @param {number[]} since
 * @returns {Float64Array}
 */
function restStates(kernels, segments, sides, rows, index, since) {
  const numbers = kernels.array('i', [index.length], index.map(BigInt));
  const times = kernels.array('f', [index.length], since);
  const states = kernels.array('f', [3, index.length]);
  if (index.length) kernels.fill_states(segments, sides, rows, numbers, times, states);
  const found = states.values.slice();
  for (const array of [numbers, times, states]) array.free();
  return found;
}

/**
 * @param {Kernels} kernels
 * @param {Floats} segments
 * @param {Floats} sides
 * @param {Floats} rows
 * @param {RestRun & { begins: Float64Array, starts: Float64Array }} run
 * @param {boolean} endless
 * @param {number} samples
 * @param {number} [until]
 * @returns {{ times: Float64Array, states: Float64Array, base: Float64Array }}
 */
function sampledRest(kernels, segments, sides, rows, run, endless, samples, until) {
  if (!samples) {
    const nothing = new Float64Array(0);
    return { times: nothing, states: nothing, base: nothing };
  }
  let shown = run.end;
  if (!endless && run.rests !== null) {
    shown = Math.min(run.end, Math.max(1.05 * run.rests, run.starts[run.starts.length - 1]) + 0.1);
  }
  const end = Math.min(until ?? shown, shown, run.end), moving = run.starts[run.starts.length - 1];
  const even = Array.from({ length: samples + 1 }, (_, k) => k < samples ? (end / samples) * k : end);
  // A short pulse has samples of its own.
  const dense = Array.from({ length: REST_RUN_DENSE }, (_, k) => (moving / REST_RUN_DENSE) * (k + 1));
  const times = Float64Array.from(
    [...even, ...[...run.begins, ...dense].filter((at) => at > 0 && at < end)]).sort();
  /** @type {number[]} */
  const index = [], since = [];
  for (let k = 0, row = 0; k < times.length; k += 1) {
    while (row + 1 < run.begins.length && run.begins[row + 1] <= times[k]) row += 1;
    index.push(row);
    since.push(times[k] - run.begins[row]);
  }
  return {
    times, states: restStates(kernels, segments, sides, rows, index, since),
    base: baseCourse(kernels, segments, run.starts, times),
  };
}
