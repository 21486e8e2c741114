// What a single pulse makes of a block at rest: fates over frequency and amplitude, one history.
import { COUNTED, sidesOf } from '../case.mjs';
import { pulseTable } from '../motions.mjs';
import { runFromRest } from './run.mjs';

/** @import { Floats, Kernels } from '../../kernels/loader.mjs' */
/** @import { SampledRun } from './run.mjs' */

/**
 * A block that a pulse meets.
 * @typedef {{ shape: string, restitution: number, nonlinear: boolean, alpha: number }} Struck
 */

/**
 * Fates at some cells, as `pulse_fates` writes them.
 * @typedef {object} PulseFates
 * @property {Uint8Array} status  a code of FATE
 * @property {Int32Array} impacts  until it overturns, or while the pulse lasts
 * @property {Int8Array} side  on which it falls, +1 or -1, else 0
 * @property {Float64Array} during  impacts and side at the pulse's end, as one number
 * @property {Float64Array} margin  beyond (above 0) or short of overturning; nan if undecided
 */

export const FATE = { rocking: 0, rest: 1, overturned: 2, lost: 3, undecided: 4 };
const PULSE_SMALLEST = 1e-3, PULSE_FLIGHTS = 30000;

/** @type {{ key: string, kernels: Kernels | null, table: Floats | null }} */
const keptTable = { key: '', kernels: null, table: null };

/**
 * Return the table of a pulse of amplitude 1 and frequency ratio 1, without the still base after
 * it.  The last one is kept: do not free it.
 * @param {Kernels} kernels
 * @param {string} shape
 * @param {boolean} nonlinear
 * @param {number} [tolerance]
 * @returns {Floats}
 */
function unitTable(kernels, shape, nonlinear, tolerance) {
  const key = `${shape} ${nonlinear} ${tolerance}`;
  if (keptTable.key === key && keptTable.kernels === kernels && keptTable.table) {
    return keptTable.table;
  }
  keptTable.table?.free();
  // A ceiling ends a march that is lost before the block lies; the margin asks for its speed then.
  const how = { nonlinear, still: false, ceiling: !nonlinear, tolerance };
  const table = pulseTable(kernels, shape, 1, 1, how);
  Object.assign(keptTable, { key, kernels, table });
  return table;
}

/**
 * Return what becomes of a block at rest under a pulse, at some cells.
 * @param {Kernels} kernels
 * @param {Struck & { amplitudes: ArrayLike<number>, ratios: ArrayLike<number>,
 *   tolerance?: number, leftOut?: number }} given
 * @returns {PulseFates}
 */
export function pulseFates(kernels, given) {
  const { shape, nonlinear, tolerance, amplitudes, ratios, leftOut } = given;
  const table = unitTable(kernels, shape, nonlinear, tolerance);
  const sides = sidesOf(kernels, { ...given, amplitude: 1, frequencyRatio: 1 });
  if (nonlinear && leftOut) {
    for (const at of [4, 9]) sides.values[at] = Math.max(sides.values[at], leftOut);
  }
  const count = amplitudes.length;
  // A pulse of amplitude 0 is none, and the kernel divides by it.
  const sizes = kernels.array('f', [count], Float64Array.from(amplitudes, (a) =>
    Math.max(a, PULSE_SMALLEST)));
  const rates = kernels.array('f', [count], ratios);
  const [status, impacts, side, during] = [0, 1, 2, 3].map(() => kernels.array('i', [count]));
  const margin = kernels.array('f', [count]);
  kernels.pulse_fates({ segments: table, sides }, sizes, rates, COUNTED, PULSE_FLIGHTS,
    { status, impacts, side, during, margin });
  const found = {
    status: Uint8Array.from(status.values, Number), impacts: Int32Array.from(impacts.values, Number),
    side: Int8Array.from(side.values, Number), during: Float64Array.from(during.values, Number),
    margin: margin.values.slice(),
  };
  for (const array of [sides, sizes, rates, status, impacts, side, during, margin]) array.free();
  return found;
}

/**
 * Return the history of a block at rest under a pulse, as `simulate` has it.
 * @param {Kernels} kernels
 * @param {Struck & { amplitude: number, ratio: number, samples?: number, until?: number }} given
 * @returns {SampledRun & { duration: number }}  duration: of the pulse
 */
export function pulseHistory(kernels, given) {
  const { shape, amplitude, ratio, nonlinear } = given;
  const segments = pulseTable(kernels, shape, amplitude, ratio, { nonlinear });
  const sides = sidesOf(kernels, { ...given, frequencyRatio: given.ratio });
  const run = runFromRest(kernels, { segments, sides }, given);
  for (const array of [segments, sides]) array.free();
  return { ...run, duration: run.starts[run.starts.length - 1] };
}
