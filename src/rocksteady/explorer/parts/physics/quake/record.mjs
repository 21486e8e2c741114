// A block at rest on the floor when a recorded ground motion begins: one run, its neighbours, the
// fates over scales, the rocking spectrum.  Horizontal motion alone; bits as in Python.

import { COUNTED, GRAVITY, evaluate, sidesOf } from '../case.mjs';
import { AT_REST, BY_IMPACT, FLIGHT_ANGLE, FLIGHT_COLUMNS, FLIGHT_DURATION, FLIGHT_EVENT, FLIGHT_PHASE,
  FLIGHT_SIDE, RUN_STATUS, statesAt } from '../history.mjs';
/** @import { Floats, Kernels } from '../../kernels/loader.mjs' */

const STILL_START = {
  side: 0, angle: 0, velocity: 0, segment: 0, half_cycles: 0, phase: 0, impacts: 0, flights: 0,
};
const RUN_FLIGHTS = 4_000_000; // flights after which a run ends
const SMALLEST_REBOUND = 1e-8; // du/d(pt), below which chatter may come to rest
const TIME_WITHOUT_LOSS = 1e4; // pivot time on the still base of a block without loss
const TIME_TO_REST = 1e15; // pivot time of any other block
const FALL_SHOWN_TO = 2; // |theta|/alpha
const LONGEST_SAMPLE = 1e6; // pivot time
const LARGEST_SAMPLE = 1e50; // in units of alpha g

const [COLUMN_DURATION, COLUMN_CONSTANT, COLUMN_SLOPE, COLUMN_CEILING, COLUMN_ALIKE] =
  [0, 2, 3, 7, 8];
const LINEAR_COLUMNS = 9, NONLINEAR_COLUMNS = 12;

/**
 * Recorded acceleration, straight between the samples, then a still base.
 * @typedef {object} GroundMotion
 * @property {Float64Array} samples  [m/s2]
 * @property {number} dt  [s]
 */

/**
 * A symmetric block with sizes.
 * @typedef {object} RecordBlock
 * @property {number} alpha  slenderness [rad]
 * @property {number} p  frequency parameter [rad/s]
 * @property {number} radius  half-diagonal [m]
 * @property {number} restitution
 * @property {boolean} nonlinear
 */

/**
 * A run, in pivot time and in units of alpha.
 * @typedef {object} RecordRun
 * @property {string} status
 * @property {number} peak  largest |theta|/alpha, up to overturning
 * @property {number} peakVelocity  largest |du/d(pt)|
 * @property {number} end  pivot time
 * @property {number | null} overturned  when it passes alpha for the last time
 * @property {number | null} rested  when it came to rest
 * @property {Float64Array} impacts  pivot times of those that leave with COUNTED or more
 * @property {Float64Array} impactVelocities  du/d(pt) before each
 * @property {number} impactCount  with those left out at the limit of flights
 * @property {Float64Array} pt  times of the curve
 * @property {Float64Array} angle  theta/alpha at them
 */

/**
 * Return a motion times a factor.
 * @param {GroundMotion} motion
 * @param {number} factor
 * @returns {GroundMotion}
 */
export function scaledMotion({ samples, dt }, factor) {
  return { dt, samples: samples.map((value) => factor * value) };
}

/**
 * Return the largest absolute acceleration [m/s2].
 * @param {GroundMotion} motion
 */
export function peakOf({ samples }) {
  return samples.reduce((most, value) => Math.max(most, Math.abs(value)), 0);
}

/**
 * Return the segment table of a motion, with the still base after it; free it.
 * @param {Kernels} kernels
 * @param {GroundMotion} motion
 * @param {boolean} nonlinear
 * @param {number} [rate]  p [rad/s], the unit of time
 * @param {number} [unit]  alpha g [m/s2], the unit of acceleration
 * @returns {Floats}
 */
export function recordTable(kernels, motion, nonlinear, rate = 1, unit = 1) {
  const count = motion.samples.length, columns = nonlinear ? NONLINEAR_COLUMNS : LINEAR_COLUMNS;
  const samples = motion.samples.map((value) => value / unit), step = motion.dt * rate;
  const table = kernels.array('f', [count, columns]), cells = table.values;
  let ceiling = 0;
  for (let row = count - 1; row >= 0; row--) {
    const at = row * columns, last = row === count - 1;
    const start = last ? 0 : samples[row], slope = last ? 0 : (samples[row + 1] - start) / step;
    ceiling = Math.max(ceiling, Math.abs(start), last ? 0 : Math.abs(start + slope * step));
    cells[at + COLUMN_DURATION] = last ? Infinity : step;
    cells[at + COLUMN_CONSTANT] = start;
    cells[at + COLUMN_SLOPE] = slope;
    cells[at + COLUMN_CEILING] = ceiling;
    cells[at + COLUMN_ALIKE] = last ? 0 : count - 2 - row;
  }
  return table;
}

/**
 * Return why a motion cannot shake a block, or nothing.
 * @param {GroundMotion} motion
 * @param {RecordBlock} block
 */
export function refusedMotion({ samples, dt }, block) {
  if (dt * block.p > LONGEST_SAMPLE) return `its samples are ${dt} s apart, too long for the block`;
  const peak = peakOf({ samples, dt });
  if (!(peak > 0)) return 'all its accelerations are zero';
  if (peak > LARGEST_SAMPLE * block.alpha * GRAVITY) return 'its accelerations are too large';
  return '';
}

/**
 * Return the run of a block under a motion, with a curve of some points, or of none.
 * @param {Kernels} kernels
 * @param {GroundMotion} motion
 * @param {RecordBlock} block
 * @param {number} [points]
 * @returns {RecordRun}
 */
export function runRecord(kernels, motion, block, points = 0) {
  const unit = block.alpha * GRAVITY;
  const segments = recordTable(kernels, motion, block.nonlinear, block.p, unit);
  const sides = sidesOf(kernels, { ...block, amplitude: 0, frequencyRatio: 0 });
  const nothing = kernels.array('f', [0]), none = kernels.array('f', [0, FLIGHT_COLUMNS]);
  const stop = block.restitution === 1 ? TIME_WITHOUT_LOSS : TIME_TO_REST;
  /** @param {Floats} rows */
  const marched = (rows) => kernels.march(
    { segments, sides }, STILL_START,
    { half_cycles: 0, phase: stop, rest_velocity: SMALLEST_REBOUND, limit: RUN_FLIGHTS },
    { rows, peaks: nothing },
  );
  const [code, { flights, impacts }] = marched(none);
  const rows = kernels.array('f', [flights, FLIGHT_COLUMNS]);
  marched(rows);
  const known = code === AT_REST && flights === RUN_FLIGHTS ? impacts : null;
  const run = { kernels, segments, sides, rows, status: RUN_STATUS[code], known };
  try {
    return describedRun(run, motion.dt * block.p, block, points);
  } finally {
    for (const array of [segments, sides, nothing, none, rows]) array.free();
  }
}

/**
 * @typedef {{ kernels: Kernels, segments: Floats, sides: Floats, rows: Floats, status: string,
 *   known: number | null }} Marched  known: impacts of a run at rest at its limit of flights
 */

/**
 * @param {Marched} run
 * @param {number} step  of the samples, in pivot time
 * @param {RecordBlock} block
 * @param {number} points
 * @returns {RecordRun}
 */
function describedRun(run, step, block, points) {
  const { kernels, segments, sides, rows, status } = run, fell = status === 'overturned';
  const count = rows.shape[0], starts = flightStarts(run, step), row = count - 1;
  const last = lastDuration(run, block);
  const [positive, negative, peakVelocity] = fell
    ? kernels.peaks_until_overturning(segments, sides, rows)
    : kernels.recorded_peaks(segments, sides, rows, last);
  const end = starts[row] + last;
  const { pt: landings, velocity } = recordLandings(run, starts);
  const counts = (/** @type {number} */ _, /** @type {number} */ k) =>
    Math.abs(block.restitution * velocity[k]) >= COUNTED;
  const impacts = landings.filter(counts);
  let overturned = null;
  if (fell) {
    const [crossed, since] = kernels.last_crossing(segments, sides, rows, 1);
    overturned = starts[crossed] + since;
  }
  const rested = status === 'at-rest' ? recordRest(run, starts, step, block, velocity[velocity.length - 1]) : null;
  const shown = rested === null ? Math.min(end, starts[row] + 10)
    : Math.min(end, Math.max(1.05 * rested, step * (segments.shape[0] - 1)) + 0.1);
  const pt = points > 0 ? curveTimes(fell ? end : shown, points, impacts) : none64();
  return {
    status, peak: Math.max(positive, negative), peakVelocity, end, overturned, rested,
    impacts, impactVelocities: velocity.filter(counts),
    impactCount: run.known ?? impacts.length, pt,
    angle: anglesAt(run, starts, pt),
  };
}

function none64() {
  return new Float64Array(0);
}

/**
 * Return the pivot times at which flights begin.
 * @param {Marched} run
 * @param {number} step
 */
function flightStarts({ segments, rows }, step) {
  const begins = new Float64Array(segments.shape[0]), flights = rows.values;
  for (let k = 1; k < begins.length; k++) begins[k] = begins[k - 1] + step;
  const starts = new Float64Array(rows.shape[0]);
  let latest = -Infinity;
  for (let row = 0; row < starts.length; row++) {
    const at = row * FLIGHT_COLUMNS;
    latest = Math.max(latest, begins[flights[at]] + flights[at + FLIGHT_PHASE]);
    starts[row] = latest;
  }
  return starts;
}

/**
 * Return the duration of the last flight; of an endless fall, until |theta| is twice alpha.
 * @param {Marched} run
 * @param {RecordBlock} block
 */
function lastDuration({ kernels, segments, sides, rows, status }, block) {
  const row = rows.shape[0] - 1, at = row * FLIGHT_COLUMNS, flights = rows.values;
  const duration = flights[at + FLIGHT_DURATION];
  if (status !== 'overturned' || Number.isFinite(duration)) return duration;
  let level = Math.max(FALL_SHOWN_TO, 1 + Math.abs(flights[at + FLIGHT_ANGLE]));
  if (block.nonlinear) level = Math.min(level, (0.5 * Math.PI) / block.alpha);
  const [crossed, since] = kernels.last_crossing(segments, sides, rows, level);
  return crossed === row ? since : 0;
}

/**
 * Return pivot times and velocities of all impacts, however slow.
 * @param {Marched} run
 * @param {Float64Array} starts
 */
function recordLandings(run, starts) {
  const flights = run.rows.values, count = starts.length;
  const ended = Array.from(starts.keys())
    .filter((row) => flights[row * FLIGHT_COLUMNS + FLIGHT_EVENT] === BY_IMPACT);
  const durations = ended.map((row) => flights[row * FLIGHT_COLUMNS + FLIGHT_DURATION]);
  const pt = Float64Array.from(ended, (row, k) =>
    row === count - 1 ? starts[row] + durations[k] : starts[row + 1]);
  const { kernels, segments, sides, rows } = run;
  const states = statesAt(kernels, segments, sides, rows, ended, durations);
  return { pt, velocity: states.slice(ended.length, 2 * ended.length) };
}

/**
 * Return when the block came to rest where it stayed, the bounces still to come included.
 * @param {Marched} run
 * @param {Float64Array} starts
 * @param {number} step
 * @param {RecordBlock} block
 * @param {number} landed  du/d(pt) before the last impact, however slow
 */
function recordRest({ kernels, segments, rows }, starts, step, block, landed) {
  const flights = rows.values, cell = (/** @type {number} */ row, /** @type {number} */ column) =>
    flights[row * FLIGHT_COLUMNS + column];
  let first = starts.length;
  while (first > 0 && cell(first - 1, FLIGHT_SIDE) === 0) first -= 1;
  const start = starts[first];
  if (first === 0 || cell(first - 1, FLIGHT_EVENT) !== BY_IMPACT) return start;
  const { restitution } = block;
  const velocity = Math.abs(restitution * landed);
  const side = cell(first - 1, FLIGHT_SIDE);
  const towards = -side * accelerationAt(segments, step, start);
  /** @param {number} push */
  const pull = (push) => {
    if (!block.nonlinear) return 1 - push;
    const own = evaluate(kernels, 'sin', block.alpha) / block.alpha;
    return own - push * evaluate(kernels, 'cos', block.alpha);
  };
  const lost = (1 - restitution) * (1 + restitution);
  return start + (2 * velocity * (1 / pull(towards) + restitution / pull(-towards))) / lost;
}

/**
 * Return the base acceleration at a pivot time, in units of alpha g.
 * @param {Floats} segments
 * @param {number} step
 * @param {number} pt
 */
function accelerationAt(segments, step, pt) {
  const [count, columns] = segments.shape, cells = segments.values;
  let begin = 0, row = 0;
  for (let next = 0; row + 1 < count; row++) {
    next = begin + step;
    if (next > pt) break;
    begin = next;
  }
  const at = row * columns;
  return cells[at + COLUMN_CONSTANT] + cells[at + COLUMN_SLOPE] * (pt - begin);
}

/**
 * Return times in order: evenly spaced, and the impacts where they are not too many.
 * @param {number} end
 * @param {number} points
 * @param {Float64Array} impacts
 */
function curveTimes(end, points, impacts) {
  const even = Float64Array.from({ length: points }, (_, k) => (end / (points - 1)) * k);
  even[points - 1] = end;
  const few = impacts.length <= points ? impacts.filter((pt) => pt <= end) : none64();
  const all = new Float64Array(points + few.length);
  all.set(even);
  all.set(few, points);
  return all.sort();
}

/**
 * Return theta/alpha at pivot times in order.
 * @param {Marched} run
 * @param {Float64Array} starts
 * @param {Float64Array} pt
 */
function anglesAt(run, starts, pt) {
  /** @type {number[]} */
  const index = [];
  const since = [];
  let row = 0;
  for (const time of pt) {
    while (row + 1 < starts.length && starts[row + 1] <= time) row += 1;
    index.push(row);
    since.push(Math.max(time - starts[row], 0));
  }
  const { kernels, segments, sides, rows } = run;
  return statesAt(kernels, segments, sides, rows, index, since).slice(0, index.length);
}

/**
 * Fates of blocks that are alike but for size and slenderness, one entry a block.
 * @typedef {object} RecordFates
 * @property {Uint8Array} status  codes of RUN_STATUS
 * @property {Float64Array} impacts
 * @property {Float64Array} peak  largest |theta|/alpha
 * @property {Float64Array} peakVelocity
 */

/**
 * Return how blocks of some uplift accelerations and rates fare.
 * @param {Kernels} kernels
 * @param {GroundMotion} motion
 * @param {RecordBlock} block
 * @param {ArrayLike<number>} lean  alpha g over the motion's scale [m/s2]
 * @param {ArrayLike<number>} rate  p [rad/s]
 * @returns {RecordFates}
 */
function fatesUnder(kernels, motion, block, lean, rate) {
  const count = lean.length;
  const one = sidesOf(kernels, { ...block, amplitude: 0, frequencyRatio: 0 });
  const own = one.values.slice(), columns = one.shape[1];
  const sides = kernels.array('f', [count, 2, columns]), cells = sides.values;
  for (let cell = 0; cell < count; cell++) {
    cells.set(own, cell * own.length);
    for (const at of [cell * own.length, cell * own.length + columns]) {
      cells[at + 1] = lean[cell];
      cells[at + 2] = rate[cell];
    }
  }
  const time = block.restitution === 1 ? TIME_WITHOUT_LOSS : TIME_TO_REST;
  const table = recordTable(kernels, motion, block.nonlinear);
  const afterwards = kernels.array('f', [count], new Float64Array(count).fill(time));
  const status = kernels.array('i', [count]), impacts = kernels.array('i', [count]);
  const peaks = kernels.array('f', [count, 2]);
  kernels.record_fates(table, { sides, afterwards }, RUN_FLIGHTS, { status, impacts, peaks });
  const highest = peaks.values;
  const found = {
    status: Uint8Array.from(status.values, Number),
    impacts: Float64Array.from(impacts.values, Number),
    peak: Float64Array.from({ length: count }, (_, cell) => highest[2 * cell]),
    peakVelocity: Float64Array.from({ length: count }, (_, cell) => highest[2 * cell + 1]),
  };
  for (const array of [one, sides, table, afterwards, status, impacts, peaks]) array.free();
  return found;
}

/**
 * Return the fates of a block over factors of a motion, as rocksteady.simulate_many.
 * @param {Kernels} kernels
 * @param {GroundMotion} motion
 * @param {RecordBlock} block
 * @param {Float64Array} scales  above 0
 */
export function fatesOverScales(kernels, motion, block, scales) {
  const unit = block.alpha * GRAVITY;
  const lean = scales.map((scale) => unit / scale);
  return fatesUnder(kernels, motion, block, lean, scales.map(() => block.p));
}

/**
 * Return the rocking spectrum over periods 2 pi/p, as rocksteady.compute_rocking_spectrum.
 * @param {Kernels} kernels
 * @param {GroundMotion} motion
 * @param {RecordBlock} block  its alpha and restitution are those of all
 * @param {Float64Array} periods  [s]
 * @param {number} scale
 */
export function rockingSpectrum(kernels, motion, block, periods, scale) {
  const lean = (block.alpha * GRAVITY) / scale;
  const rates = periods.map((period) => (2 * Math.PI) / period);
  return fatesUnder(kernels, motion, block, periods.map(() => lean), rates);
}

/** @typedef {{ scale: number, restitution: number, alpha: number, status: string, peak: number }} RecordNeighbour */

/**
 * Return the bodies and factors of the 26 neighbours of a case, as rocksteady.check_neighbours.
 * @param {Kernels} kernels
 * @param {RecordBlock} block
 * @returns {{ scale: number, block: RecordBlock }[]}
 */
export function neighbourCases(kernels, block) {
  const { alpha, radius, p, restitution } = block;
  const height = radius * evaluate(kernels, 'cos', alpha);
  const gyration = Math.max((GRAVITY * radius) / (p * p) - radius * radius, 0);
  const shapes = [block, ...[1 - 0.02, 1 + 0.02].map((factor) => {
    const tilted = Math.min(factor * alpha, 0.5 * (alpha + 0.5 * Math.PI));
    const long = height / evaluate(kernels, 'cos', tilted);
    const rate = Math.sqrt((GRAVITY * long) / (gyration + long * long));
    return { ...block, alpha: tilted, radius: long, p: rate };
  })];
  const bodies = shapes.flatMap((shape) => [0, -0.03, 0.03].map((change) => ({
    ...shape,
    restitution: Math.min(
      Math.max(restitution + change, 0.5 * restitution), 0.5 * (1 + restitution),
    ),
  })));
  bodies[0] = block;
  const cases = bodies.flatMap((body) => [0.95, 1, 1.05].map((scale) => ({ scale, block: body })));
  return cases.filter((_, k) => k !== 1); // that is the case itself
}

/**
 * Return how some neighbours end.
 * @param {Kernels} kernels
 * @param {GroundMotion} motion
 * @param {{ scale: number, block: RecordBlock }[]} cases
 * @returns {RecordNeighbour[]}
 */
export function runNeighbours(kernels, motion, cases) {
  return cases.map(({ scale, block }) => {
    const { status, peak } = runRecord(kernels, scaledMotion(motion, scale), block);
    return { scale, restitution: block.restitution, alpha: block.alpha, status, peak };
  });
}
