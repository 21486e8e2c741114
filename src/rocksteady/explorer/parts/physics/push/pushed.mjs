// A block on ground that moves while it is marched: the march goes on from the last state.

import { GRAVITY, sidesOf } from '../case.mjs';
import { recordTable } from '../motions.mjs';
import { runOf } from '../run.mjs';
import { openEnded } from './falling.mjs';
import { PUSH_STEP } from './spring.mjs';

/** @import { Kernels, March } from '../../kernels/loader.mjs' */
/** @import { RecordBlock } from '../quake/record.mjs' */

/**
 * What a stretch of the march has brought.
 * @typedef {object} Pushed
 * @property {March} state  from which it goes on
 * @property {boolean} lies  on its side
 * @property {number} peak  largest |theta|/alpha of the stretch
 * @property {{ time: number, side: number, speed: number }[]} impacts  since its start [s]; du/d(pt)
 */

/** A block at rest. @type {March} */
export const STANDING = Object.freeze({
  side: 0, angle: 0, velocity: 0, segment: 0, half_cycles: 0, phase: 0, impacts: 0, flights: 0,
});

/**
 * March a block through some samples of its ground, PUSH_STEP apart.
 * @param {Kernels} kernels
 * @param {RecordBlock} block
 * @param {March} start
 * @param {Float64Array} samples  [m/s2], the one at the start first
 * @returns {Pushed}
 */
export function pushOn(kernels, block, start, samples) {
  const { alpha, p, nonlinear } = block;
  const table = recordTable(kernels, { samples, dt: PUSH_STEP }, nonlinear, p, alpha * GRAVITY);
  const sides = sidesOf(kernels, { ...block, amplitude: 0, frequencyRatio: 0 });
  // Nobody knows what the hand will do: nothing is proved but that the block lies.
  const run = runOf(kernels, { segments: openEnded(table, samples.length - 1), sides }, { start });
  const { impacts, status, state, peaks } = run;
  table.free();
  sides.free();
  return {
    state: { ...state, segment: 0, half_cycles: 0, phase: 0, impacts: 0, flights: 0 },
    lies: status === 'overturned',
    peak: Math.max(peaks[0], peaks[1]),
    impacts: Array.from(impacts.time, (time, k) =>
      ({ time: time / p, side: impacts.side[k], speed: Math.abs(impacts.before[k]) })),
  };
}
