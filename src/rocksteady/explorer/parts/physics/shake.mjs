// What a block at rest does that is shaken on and on, or pushed once, by the full equations.
import { evaluate, GRAVITY, rectangleOf } from './case.mjs';
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
 * Shakings of a block: harmonic ones that go on, or single sines; the axes of a map.
 * @typedef {object} Shaken
 * @property {RecordBlock} block
 * @property {boolean} push  one sine
 * @property {ArrayLike<number>} x  frequency [Hz]
 * @property {ArrayLike<number>} y  largest acceleration [g]
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
export const SHOWN = 20; // shakes of a film
const SETTLED = 48; // shakes after which the lean of what has not repeated is taken
const AFTER = 14, TUMBLE = 8; // pivot time of a reel after a push, and after what goes on
const CENTIMETRE = 0.01, TURNED = 4; // [m] from width to width, widths in turn that are otherwise
const HELD = 1; // [s] for which a block that lies is shown

/**
 * Return the fates of a block under some shakings: a job of the pool.
 * @param {Kernels} kernels
 * @param {Shaken} asked
 * @returns {{ fate: Uint8Array }}
 */
export function shakenCells(kernels, { block, push, x, y }) {
  const lift = evaluate(kernels, 'tan', block.alpha), fate = new Uint8Array(x.length);
  const lifted = Array.from(y, (_, k) => k).filter((k) => y[k] > lift);
  const all = lifted.map((k) => pulseNumbers(block, y[k], x[k]));
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
 * Return the fates of blocks of some sizes under one shaking: a job of the pool.
 * @param {Kernels} kernels
 * @param {{ restitution: number | null, push: boolean, hz: number, g: number, x: ArrayLike<number>,
 *   y: ArrayLike<number> }} asked  widths and heights [m]; restitution null stands for Housner's
 * @returns {{ fate: Uint8Array }}
 */
export function sizeCells(kernels, { restitution, push, hz, g, x, y }) {
  const fate = Uint8Array.from(x, (width, k) => {
    const { housner, ...measures } = rectangleOf(kernels, { width, height: y[k] });
    const block = { ...measures, restitution: restitution ?? housner, nonlinear: true };
    if (evaluate(kernels, 'tan', block.alpha) < g && !(block.restitution > 0)) return SHAKEN.undecided;
    return shakenCells(kernels, { block, push, x: [hz], y: [g] }).fate[0];
  });
  return { fate };
}

/** @typedef {{ falls: boolean, turns: number | null, last: number | null }} WidthTurn  [m]; null where no width is
 * otherwise, and `last` up to which none is, were it only for a centimetre */

/**
 * Return the nearest other width, in centimetres, at which it is otherwise whether a block falls,
 * and stays so for some more: narrower where it stands, wider where it falls; a job of the pool.
 * @param {Kernels} kernels
 * @param {{ restitution: number | null, push: boolean, hz: number, g: number, width: number,
 *   height: number, least: number, most: number }} asked  [m]; of the widths
 * @returns {WidthTurn}
 */
export function widthTurn(kernels, { width, height, least, most, ...shaking }) {
  const falls = (/** @type {number[]} */ widths) => Array.from(
    sizeCells(kernels, { ...shaking, x: widths, y: widths.map(() => height) }).fate,
    (code) => code === SHAKEN.once || code === SHAKEN.after);
  const [now] = falls([width]), way = now ? CENTIMETRE : -CENTIMETRE;
  const all = Array.from({ length: Math.ceil((most - least) / CENTIMETRE) }, (_, k) => width + (k + 1) * way)
    .filter((each) => each > least - 1e-9 && each < most + 1e-9);
  /** @type {number[]} */
  let turned = []; // widths in turn that are otherwise
  let steady = true;
  for (const each of all) {
    turned = falls([each])[0] === now ? [] : [...turned, each];
    steady &&= !turned.length;
    if (turned.length === TURNED) break;
  }
  return { falls: now, turns: turned[0] ?? null, last: steady ? all[all.length - 1] ?? null : null };
}

/**
 * Return the run of a block under one shaking: a job of the pool.
 * @param {Kernels} kernels
 * @param {{ block: RecordBlock, push: boolean, hz: number, g: number }} asked
 * @returns {ShakenRun}
 */
export function shakenRun(kernels, { block, push, hz, g }) {
  const { alpha, p } = block, { amplitude, ratio } = pulseNumbers(block, g, hz);
  const { fate: [fate] } = shakenCells(kernels, { block, push, x: [hz], y: [g] });
  const seconds = push ? 1 / hz + AFTER / p : SHAKES / hz + TUMBLE / p;
  const reel = baseReel(kernels, {
    block, seconds, ...(push ? { pulse: { shape: 'one-sine', amplitude, ratio } } : { harmonic: { amplitude, ratio } }),
  });
  // So that the ground, whose push is a line between samples, goes to and fro about one place.
  const turned = 2 * Math.PI * hz, speed = push ? 0 : ((-g * GRAVITY) / turned) * (1 - (turned * reel.step) ** 2 / 12);
  const falls = fate === SHAKEN.once || fate === SHAKEN.after;
  const { lies, ...film } = filmOf(reel, falls, push ? seconds : SHOWN / hz, speed);
  const { time } = reel.impacts, until = lies ?? Infinity;
  const settles = fate === SHAKEN.stands && !push;
  const found = settles ? attractorOf(kernels, { ...block, amplitude, frequencyRatio: ratio }, { kind: 'rest' }, SHAKES) : null;
  const late = settles ? reel.angle.slice(Math.round(SETTLED / hz / reel.step)) : reel.angle;
  const most = found?.orbit ? Math.max(found.orbit.highest, -found.orbit.lowest)
    : late.reduce((top, u) => Math.max(top, Math.abs(u)), 0);
  return {
    fate, lies, ...film, impacts: time.filter((at) => at <= until).length, lean: most * alpha,
    kind: found?.orbit ? found.kind : 'rocking', period: found?.period ?? null,
  };
}

/**
 * Return what is shown of a run: up to a time, or until the block has lain for a while.
 * @param {Reel & { base: Float64Array }} reel
 * @param {boolean} falls
 * @param {number} seconds
 * @param {number} speed  of the ground at the start [m/s]
 * @returns {Pick<ShakenRun, 'lies' | 'reel' | 'places'>}
 */
export function filmOf(reel, falls, seconds, speed) {
  const { alpha } = reel.block, flat = (0.5 * Math.PI * (1 - 1e-9)) / alpha;
  const down = falls ? reel.angle.findIndex((u) => Math.abs(u) >= flat) : -1, lies = down < 0 ? null : down * reel.step;
  const count = Math.ceil((lies === null ? seconds : lies + HELD) / reel.step) + 1;
  const cut = (/** @type {Float64Array} */ course) => course.slice(0, count), base = cut(reel.base);
  return {
    lies, reel: { ...reel, angle: cut(reel.angle), velocity: cut(reel.velocity), base },
    places: placesOf(base.map((a) => a * alpha * GRAVITY), reel.step, speed),
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
