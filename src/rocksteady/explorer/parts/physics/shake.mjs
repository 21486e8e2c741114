// What a block at rest does that is shaken on and on, or pushed once, by the full equations.
import { evaluate, GRAVITY } from './case.mjs';
import { attractorOf } from './attractor.mjs';
import { FATE, pulseFates } from './demand/pulse.mjs';
import { baseReel } from './push/falling.mjs';
import { WHOLE_CELL, settledRows } from './settled.mjs';
import { pulseNumbers } from './story/pulses.mjs';

/** @import { Kernels } from '../kernels/loader.mjs' */
/** @import { Attractor } from './attractor.mjs' */
/** @import { RecordBlock } from './quake/record.mjs' */
/** @import { Reel } from './push/falling.mjs' */

/**
 * Shakings of a block: harmonic ones that go on, or single sines.
 * @typedef {object} Shaken
 * @property {RecordBlock} block
 * @property {boolean} push  one sine
 * @property {ArrayLike<number>} hz
 * @property {ArrayLike<number>} g  largest acceleration
 */

/**
 * A run of a shaken block as the laboratory says and shows it.
 * @typedef {object} ShakenRun
 * @property {number} fate  a code of SHAKEN
 * @property {Attractor['kind'] | 'rocking'} kind  of what goes on; rocking: it has not repeated yet
 * @property {number | null} period  in shakes
 * @property {number} lean  largest |theta| [rad]: of what it settles to, or after a push
 * @property {number | null} lies  when it lies on the ground [s]
 * @property {number} impacts  until then
 * @property {Reel & { base: Float64Array }} reel
 * @property {Float64Array} places  of the ground, at the samples of the reel [m]
 */

export const SHAKEN = { still: 0, stands: 1, once: 2, after: 3, undecided: 4 };
export const SHAKES = 64; // after which what has not fallen counts as rocking
const FALLS = 2n; // outcome of `settle_cells`
const SHOWN = 20; // shakes of a film
const SETTLED = 48; // shakes after which the lean of what has not repeated is taken
const AFTER = 14, TUMBLE = 8; // pivot time of a reel after a push, and after what goes on
const HELD = 1; // [s] for which a block that lies is shown

/**
 * Return the fates of a block under some shakings: a job of the pool.
 * @param {Kernels} kernels
 * @param {Shaken} asked
 * @returns {{ fate: Uint8Array }}
 */
export function shakenCells(kernels, { block, push, hz, g }) {
  const lift = evaluate(kernels, 'tan', block.alpha), fate = new Uint8Array(hz.length);
  const lifted = Array.from(g, (_, k) => k).filter((k) => g[k] > lift);
  const all = lifted.map((k) => pulseNumbers(block, g[k], hz[k]));
  const amplitude = Float64Array.from(all, (one) => one.amplitude), ratio = Float64Array.from(all, (one) => one.ratio);
  if (push && lifted.length) {
    const { status, impacts } = pulseFates(kernels, { ...block, shape: 'one-sine', amplitudes: amplitude, ratios: ratio });
    lifted.forEach((k, i) => {
      const fell = impacts[i] ? SHAKEN.after : SHAKEN.once;
      const open = status[i] === FATE.undecided || status[i] === FATE.lost;
      fate[k] = status[i] === FATE.overturned ? fell : open ? SHAKEN.undecided : SHAKEN.stands;
    });
  } else if (lifted.length) {
    const none = new Float64Array(lifted.length), from = { angle: none, velocity: none, phase: none };
    settledRows(kernels, { ...block, amplitude: 1, frequencyRatio: 1 }, { amplitude, ratio, ...from }, SHAKES)
      .forEach(({ whole }, i) => { fate[lifted[i]] = whole[WHOLE_CELL.outcome] === FALLS ? SHAKEN.once : SHAKEN.stands; });
  }
  return { fate };
}

/**
 * Return the run of a block under one shaking: a job of the pool.
 * @param {Kernels} kernels
 * @param {{ block: RecordBlock, push: boolean, hz: number, g: number }} asked
 * @returns {ShakenRun}
 */
export function shakenRun(kernels, { block, push, hz, g }) {
  const { alpha, p } = block, { amplitude, ratio } = pulseNumbers(block, g, hz);
  const { fate: [fate] } = shakenCells(kernels, { block, push, hz: [hz], g: [g] });
  const seconds = push ? 1 / hz + AFTER / p : SHAKES / hz + TUMBLE / p;
  const reel = baseReel(kernels, {
    block, seconds, ...(push ? { pulse: { shape: 'one-sine', amplitude, ratio } } : { harmonic: { amplitude, ratio } }),
  });
  const falls = fate === SHAKEN.once || fate === SHAKEN.after;
  const flat = (0.5 * Math.PI * (1 - 1e-9)) / alpha, down = falls ? reel.angle.findIndex((u) => Math.abs(u) >= flat) : -1;
  const lies = down < 0 ? null : down * reel.step;
  const end = lies === null ? push ? seconds : SHOWN / hz : lies + HELD, count = Math.ceil(end / reel.step) + 1;
  // So that the ground, whose push is a line between samples, goes to and fro about one place.
  const turned = 2 * Math.PI * hz, speed = push ? 0 : ((-g * GRAVITY) / turned) * (1 - (turned * reel.step) ** 2 / 12);
  const shown = { ...reel, angle: reel.angle.slice(0, count), velocity: reel.velocity.slice(0, count), base: reel.base.slice(0, count) };
  const { time } = reel.impacts, until = lies ?? Infinity;
  const settles = fate === SHAKEN.stands && !push;
  const found = settles ? attractorOf(kernels, { ...block, amplitude, frequencyRatio: ratio }, { kind: 'rest' }, SHAKES) : null;
  const late = settles ? reel.angle.slice(Math.round(SETTLED / hz / reel.step)) : reel.angle;
  const most = found?.orbit ? Math.max(found.orbit.highest, -found.orbit.lowest)
    : late.reduce((top, u) => Math.max(top, Math.abs(u)), 0);
  return {
    fate, lies, reel: shown, impacts: time.filter((at) => at <= until).length, lean: most * alpha,
    kind: found?.orbit ? found.kind : 'rocking', period: found?.period ?? null,
    places: placesOf(shown.base.map((a) => a * alpha * GRAVITY), reel.step, speed),
  };
}

/** Return where ground is that moves from 0 at a speed. @param {Float64Array} push  [m/s2]
 * @param {number} step  [s] @param {number} speed  [m/s] */
function placesOf(push, step, speed) {
  let place = 0, pace = speed;
  return push.map((here, k) => {
    if (!k) return 0;
    const before = push[k - 1];
    place += step * (pace + (step * (2 * before + here)) / 6);
    pace += 0.5 * step * (before + here);
    return place;
  });
}
