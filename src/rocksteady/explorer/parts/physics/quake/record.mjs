// A block at rest on the floor when a recorded ground motion begins: one run, its neighbours, the
// fates over scales, the rocking spectrum.  Horizontal motion alone; bits as in Python.

import { GRAVITY, evaluate, sidesOf } from '../case.mjs';
import { recordTable, scaledMotion } from '../motions.mjs';
import { flightsAt, runOf, statesAt } from '../run.mjs';

/** @import { Kernels } from '../../kernels/loader.mjs' */
/** @import { GroundMotion } from '../motions.mjs' */

const RUN_FLIGHTS = 4_000_000; // flights after which a run ends
const LONGEST_SAMPLE = 1e6; // pivot time
const LARGEST_SAMPLE = 1e50; // in units of alpha g

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
 * Return the largest absolute acceleration [m/s2].
 * @param {GroundMotion} motion
 */
export function peakOf({ samples }) {
  return samples.reduce((most, value) => Math.max(most, Math.abs(value)), 0);
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
  const step = motion.dt * block.p;
  const segments = recordTable(kernels, motion, block.nonlinear, block.p, block.alpha * GRAVITY);
  const sides = sidesOf(kernels, { ...block, amplitude: 0, frequencyRatio: 0 });
  const run = runOf(kernels, { segments, sides });
  const { status, end, overturned, rested, impacts } = run;
  const [positive, negative, peakVelocity] = run.peaks;
  const shown = rested === null ? Math.min(end, run.starts[run.flights - 1] + 10)
    : Math.min(end, Math.max(1.05 * rested, step * (segments.shape[0] - 1)) + 0.1);
  const pt = points > 0 ? curveTimes(overturned === null ? shown : end, points, impacts.time)
    : new Float64Array(0);
  const states = statesAt(kernels, run.tables, run.rows, flightsAt(run.starts, pt));
  segments.free();
  sides.free();
  return {
    status, peak: Math.max(positive, negative), peakVelocity, end, overturned, rested,
    impacts: impacts.time, impactVelocities: impacts.before, impactCount: run.impactCount, pt,
    angle: states.slice(0, pt.length),
  };
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
  const few = impacts.filter((pt) => impacts.length <= points && pt <= end);
  const all = new Float64Array(points + few.length);
  all.set(even);
  all.set(few, points);
  return all.sort();
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
  const table = recordTable(kernels, motion, block.nonlinear);
  const [, time] = kernels.run_end({ segments: table, sides: one }, 0);
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
