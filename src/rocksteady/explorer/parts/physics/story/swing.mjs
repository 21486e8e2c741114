// A block that is let go from a tilt on a still base.

/** @import { Kernels, March } from '../../kernels/loader.mjs' */
/** @import { RecordBlock } from '../quake/record.mjs' */
/** @import { Reel } from '../push/falling.mjs' */
import { sidesOf } from '../case.mjs';
import { reelOf } from '../push/falling.mjs';
import { STANDING } from '../push/pushed.mjs';
import { runOf } from '../run.mjs';

/**
 * @typedef {object} Swing
 * @property {Reel} reel
 * @property {number[]} rocks  times from impact to impact [s]
 * @property {number} quarter  from letting go to the first impact [s]
 */

const NONLINEAR_COLUMNS = 12;
const TWO_IMPACTS = 4; // flights that hold two impacts
const RELEASE_TILTS = 48, RELEASE_SPEEDS = 60;

/**
 * Let a block go.
 * @param {Kernels} kernels
 * @param {RecordBlock} block
 * @param {number} tilt  theta/alpha
 * @param {number} seconds
 * @returns {Swing}
 */
export function letGo(kernels, block, tilt, seconds) {
  const start = { ...STANDING, side: 1, angle: tilt };
  const reel = reelOf(kernels, block, stillTable(kernels), seconds, { start });
  const { time } = reel.impacts;
  return { reel, rocks: Array.from(time.subarray(1), (at, k) => at - time[k]), quarter: time[0] };
}

/**
 * Return how long it takes from impact to impact, over the tilt that is reached between them.
 * @param {Kernels} kernels
 * @param {RecordBlock} block
 * @returns {{ tilt: number, time: number }[]}
 */
export function rockTimes(kernels, block) {
  return Array.from({ length: RELEASE_TILTS }, (_, k) => (k + 1) / (RELEASE_TILTS + 0.5)).map((tilt) => ({
    tilt, time: 2 * firstImpact(kernels, block, { angle: tilt }),
  }));
}

/**
 * Return the restitution between impacts that were heard: the middle one of what each pair of
 * intervals says.
 * @param {Kernels} kernels
 * @param {RecordBlock} block
 * @param {number[]} heard  times of impacts [s]
 * @returns {number | null}  null where there are too few
 */
export function restitutionHeard(kernels, block, heard) {
  const known = Array.from({ length: RELEASE_SPEEDS }, (_, k) => {
    const velocity = (k + 1) / (RELEASE_SPEEDS + 2);
    return { velocity, lasts: firstImpact(kernels, block, { velocity }) };
  });
  const speedOf = (/** @type {number} */ lasts) => {
    const k = known.findIndex((each) => each.lasts >= lasts);
    if (k < 1) return NaN;
    const [low, high] = [known[k - 1], known[k]];
    return low.velocity
      + ((lasts - low.lasts) / (high.lasts - low.lasts)) * (high.velocity - low.velocity);
  };
  const speeds = heard.slice(1).map((time, k) => speedOf(time - heard[k]));
  const shares = speeds.slice(1).map((speed, k) => speed / speeds[k])
    .filter((share) => share > 0.3 && share < 1.3).sort((one, other) => one - other);
  return shares.length > 1 ? shares[shares.length >> 1] : null;
}

/** @param {Kernels} kernels */
function stillTable(kernels) {
  return kernels.array('f', [1, NONLINEAR_COLUMNS], [Infinity, ...new Array(NONLINEAR_COLUMNS - 1).fill(0)]);
}

/**
 * Return how long a block takes from its first impact to its second, let go from a tilt [s].
 * @param {Kernels} kernels
 * @param {RecordBlock} block
 * @param {number} tilt  theta/alpha
 */
export function firstRock(kernels, block, tilt) {
  const [first, second] = impactTimes(kernels, block, { angle: tilt }, TWO_IMPACTS);
  return second - first;
}

/** @param {Kernels} kernels @param {RecordBlock} block @param {Partial<March>} start */
function firstImpact(kernels, block, start) {
  return impactTimes(kernels, block, start, 1)[0] ?? Infinity;
}

/**
 * Return when a block on a still base strikes it [s].
 * @param {Kernels} kernels
 * @param {RecordBlock} block
 * @param {Partial<March>} start
 * @param {number} most  flights
 */
function impactTimes(kernels, block, start, most) {
  const segments = stillTable(kernels);
  const sides = sidesOf(kernels, { ...block, amplitude: 0, frequencyRatio: 0 });
  const run = runOf(kernels, { segments, sides }, { start: { ...STANDING, side: 1, ...start }, most });
  segments.free();
  sides.free();
  return Array.from(run.impacts.time, (at) => at / block.p);
}
