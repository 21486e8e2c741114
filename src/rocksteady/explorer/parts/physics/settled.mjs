// What motions settle to, as `settled_cells` finds it: those of the linear model side by side, and
// one by one what the lanes leave over.

import { sidesOf } from './case.mjs';

/** @import { Floats, Kernels, Outcomes, States } from '../kernels/loader.mjs' */
/** @import { Case } from './case.mjs' */

// What the kernels write (kernels/batch/attractors.py, kernels/orbits/settle.py).
export const WHOLE_CELL = { columns: 7, outcome: 0, passages: 2, periods: 3, rests: 4, symmetric: 5 };
export const REAL_CELL = { columns: 6, highest: 2, lowest: 3, least: 5 };
const LEFT_OVER = -1n;

/**
 * Motions, one a cell: the shaking and the state at the start.
 * @typedef {object} Motions
 * @property {ArrayLike<number>} amplitude
 * @property {ArrayLike<number>} ratio
 * @property {ArrayLike<number>} angle
 * @property {ArrayLike<number>} velocity
 * @property {ArrayLike<number>} phase  of the shaking [rad]
 */

/** @typedef {{ whole: BigInt64Array, real: Float64Array }} SettledRow */

/**
 * Follow motions until it is known what they settle to; return the rows of the kernels.
 * @param {Kernels} kernels
 * @param {Case} given
 * @param {Motions} motions
 * @param {number} cycles  forcing periods at most
 * @returns {SettledRow[]}
 */
export function settledRows(kernels, given, motions, cycles) {
  /** @type {SettledRow[]} */
  const rows = [];
  const all = Array.from(motions.ratio, (_, i) => i);
  const left = given.nonlinear || !all.length ? all : settleThrough(inLanes, all);
  if (left.length) settleThrough(oneByOne, left);
  return rows;

  /** @type {(call: typeof inLanes, which: number[]) => number[]} */
  function settleThrough(call, which) {
    const count = which.length, { columns } = WHOLE_CELL, { columns: reals } = REAL_CELL;
    const { amplitude, ratio, angle, velocity, phase } = motions;
    const whole = kernels.array('i', [count, columns]), real = kernels.array('f', [count, reals]);
    const [a, w, from, speed, start, rest] = [amplitude, ratio, angle, velocity, phase, phase].map(
      (of) => kernels.array('f', [count], Float64Array.from(which, (i) => of[i])));
    const turns = kernels.array('i', [count]);
    kernels.fill_clocks(start, turns, rest);
    const side = kernels.array('i', [count], BigInt64Array.from(
      which, (i) => BigInt(Math.sign(angle[i] || velocity[i]))));
    const states = { side, angle: from, velocity: speed, half_cycles: turns, phase: rest };
    call(kernels, given, [a, w], [states, cycles, { whole, real }]);
    const [integers, numbers] = [whole.values, real.values];
    which.forEach((i, row) => {
      rows[i] = { whole: integers.slice(row * columns, (row + 1) * columns),
        real: numbers.slice(row * reals, (row + 1) * reals) };
    });
    for (const array of [a, w, from, speed, start, rest, turns, side, whole, real]) array.free();
    return which.filter((i) => rows[i].whole[WHOLE_CELL.outcome] === LEFT_OVER);
  }
}

/** @typedef {[States, number, Outcomes]} FromStart */

/** @type {(kernels: Kernels, given: Case, shaking: Floats[], from: FromStart) => void} */
function inLanes(kernels, given, [amplitude, ratio], from) {
  const count = ratio.shape[0];
  const restitution = kernels.array('f', [count], new Float64Array(count).fill(given.restitution));
  kernels.lane_attractors({ amplitude, frequency_ratio: ratio, restitution }, ...from);
  restitution.free();
}

/** @type {typeof inLanes} */
function oneByOne(kernels, given, [amplitude, ratio], from) {
  const one = sidesOf(kernels, given);
  const size = one.values.length;
  const sides = kernels.array('f', [ratio.shape[0], ...one.shape]);
  const values = sides.values;
  for (let i = 0; i < ratio.shape[0]; i += 1) values.set(one.values, i * size);
  one.free();
  kernels.settle_cells({ amplitude, frequency_ratio: ratio, sides }, ...from);
  sides.free();
}
