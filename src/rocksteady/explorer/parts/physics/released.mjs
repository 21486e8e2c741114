// What a block does that is let go from a tilt, on still ground or on ground that shakes on and on.

/** @import { Kernels } from '../kernels/loader.mjs' */
/** @import { Attractor } from './attractor.mjs' */
/** @import { RecordBlock } from './quake/record.mjs' */
/** @import { ShakenRun } from './shake.mjs' */
import { ATTRACTOR_KINDS, attractorOf } from './attractor.mjs';
import { settleStates } from './basins.mjs';
import { GRAVITY } from './case.mjs';
import { START_WINDOW } from '../kernels/window.mjs';
import { baseReel } from './push/falling.mjs';
import { SHAKEN, SHOWN, filmOf } from './shake.mjs';
import { firstRock } from './story/swing.mjs';

/**
 * A block and the ground on which it is let go; amplitude and ratio of the shaking, 0 and any of
 * still ground.
 * @typedef {{ block: RecordBlock, amplitude: number, ratio: number }} Released
 */

/**
 * A run of a block that was let go.
 * @typedef {Pick<ShakenRun, 'fate' | 'lies' | 'reel' | 'places'>
 *   & { kind: Attractor['kind'], period: number | null, rock: number }} ReleasedRun
 *   rock: from the first impact to the second [s]
 */

const STILL = 10; // pivot time of a film on still ground

/** Code of SHAKEN of each kind of attractor. @type {Readonly<Record<string, number>>} */
const CODES = { rest: SHAKEN.still, overturned: SHAKEN.once, undecided: SHAKEN.undecided };

/** @param {Released} given */
function caseOf({ block, amplitude, ratio }) {
  return { ...block, amplitude, frequencyRatio: ratio };
}

/**
 * Return what some states come to, the phase of the shaking being 0: a job of the pool.
 * @param {Kernels} kernels
 * @param {Released & { x: ArrayLike<number>, y: ArrayLike<number> }} asked  theta/alpha and du/d(pt)
 * @returns {{ fate: Uint8Array }}
 */
export function startCells(kernels, { x, y, ...released }) {
  const { kind } = settleStates(kernels, { given: caseOf(released), angles: x, velocities: y });
  return { fate: Uint8Array.from(kind, (code) => CODES[ATTRACTOR_KINDS[code]] ?? SHAKEN.stands) };
}

/**
 * Return the run of a block from a state: a job of the pool.
 * @param {Kernels} kernels
 * @param {Released & { angle: number, velocity: number }} asked
 * @returns {ReleasedRun}
 */
export function releasedRun(kernels, { angle, velocity, ...released }) {
  const { block, amplitude, ratio } = released, { alpha, p } = block;
  const { kind, period } = attractorOf(kernels, caseOf(released), { kind: 'state', angle, velocity }, START_WINDOW.cycles);
  const shaken = amplitude > 0, seconds = shaken ? (2 * Math.PI * SHOWN) / (ratio * p) : STILL / p;
  const reel = baseReel(kernels, {
    block, seconds: seconds + STILL / p, start: { angle, velocity }, ...(shaken ? { harmonic: { amplitude, ratio } } : {}),
  });
  const falls = kind === 'overturned', { time } = reel.impacts;
  const speed = shaken ? -(amplitude * alpha * GRAVITY) / (ratio * p) : 0;
  return {
    ...filmOf(reel, falls, seconds, speed), kind, period, fate: CODES[kind] ?? SHAKEN.stands,
    rock: time.length > 1 ? time[1] - time[0] : NaN,
  };
}

/**
 * Return how long the first rock takes over the tilt at the start: a job of the pool.
 * @param {Kernels} kernels
 * @param {{ block: RecordBlock, tilts: number[] }} asked  theta/alpha
 * @returns {{ x: number, y: number }[]}  tilts, and seconds from the first impact to the second
 */
export function rockCurve(kernels, { block, tilts }) {
  return tilts.map((tilt) => ({ x: tilt, y: firstRock(kernels, block, tilt) }));
}
