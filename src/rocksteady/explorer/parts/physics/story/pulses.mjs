// Blocks at rest under one sine: films, and fates over its length or its strength.

/** @import { Kernels } from '../../kernels/loader.mjs' */
/** @import { RecordBlock } from '../quake/record.mjs' */
/** @import { Reel } from '../push/falling.mjs' */
import { GRAVITY, rectangleOf } from '../case.mjs';
import { pulseTable } from '../motions.mjs';
import { reelOf } from '../push/falling.mjs';

export const SHAPE = 'one-sine';

/**
 * A homogeneous rectangle in the full equations, with Housner's restitution where none is given.
 * @param {Kernels} kernels
 * @param {number} width  [m]
 * @param {number} height  [m]
 * @param {number} [restitution]
 * @returns {RecordBlock}
 */
export function rectangle(kernels, width, height, restitution) {
  const measures = rectangleOf(kernels, { width, height });
  return { ...measures, restitution: restitution ?? measures.housner, nonlinear: true };
}

/**
 * Return a pulse as the kernels see it.
 * @param {RecordBlock} block
 * @param {number} strength  [g]
 * @param {number} frequency  [Hz]
 */
export function pulseNumbers({ alpha, p }, strength, frequency) {
  return {
    amplitude: (strength * GRAVITY) / (alpha * GRAVITY), ratio: (2 * Math.PI * frequency) / p,
  };
}

/**
 * Film a block under a pulse.
 * @param {Kernels} kernels
 * @param {RecordBlock} block
 * @param {number} strength  [g]
 * @param {number} frequency  [Hz]
 * @param {number} seconds
 * @returns {Reel}
 */
export function pulseReel(kernels, block, strength, frequency, seconds) {
  const { amplitude, ratio } = pulseNumbers(block, strength, frequency);
  const table = pulseTable(kernels, SHAPE, amplitude, ratio, { nonlinear: block.nonlinear });
  return reelOf(kernels, block, table, seconds);
}

/**
 * Return what a worker is asked for fates under pulses, as `pulseFates`.
 * @param {RecordBlock} block
 * @param {{ strength: number, frequency: number }[]} pulses
 */
export function fatesAsked(block, pulses) {
  const all = pulses.map(({ strength, frequency }) => pulseNumbers(block, strength, frequency));
  return {
    ...block, shape: SHAPE, amplitudes: all.map(({ amplitude }) => amplitude),
    ratios: all.map(({ ratio }) => ratio),
  };
}

/**
 * Return the acceleration of the base at a time over the strength of its pulse.
 * @param {number} time  over the length of the pulse
 */
export function pulseShape(time) {
  return time > 0 && time < 1 ? Math.sin(2 * Math.PI * time) : 0;
}

/**
 * Return where the ground is, in strength times the length squared, which only pictures need.
 * @param {number} time  over the length of the pulse
 */
export function pulsePlace(time) {
  const turn = 2 * Math.PI, at = Math.min(Math.max(time, 0), 1);
  return (at - Math.sin(turn * at) / turn) / turn;
}
