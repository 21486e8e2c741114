// Words and units that the panels of pulses and designs share.

/** @import { App } from '../../shell/app.mjs' */
/** @import { State } from '../../shell/state.mjs' */
import { numeral } from '../../draw/scale.mjs';
import { blockNumbers } from '../../shell/state.mjs';

/**
 * Return what a value of the state times a unit is shown as.
 * @typedef {{ amplitude: number, frequency: number, time: number, angle: number,
 *   a: string, f: string, t: string, u: string, si: boolean }} ShownUnits
 *   factors and the words after a number
 */

/**
 * @param {App} app
 * @param {State} state
 * @returns {ShownUnits}
 */
export function unitsOf(app, state) {
  if (state.units !== 'si') {
    return { amplitude: 1, frequency: 1, time: 1, angle: 1, a: '', f: '', t: '', u: ' α', si: false };
  }
  const { alpha, p } = blockNumbers(app.kernels, state);
  return {
    amplitude: alpha, frequency: p / (2 * Math.PI), time: 1 / p, angle: (alpha * 180) / Math.PI,
    a: ' g', f: ' Hz', t: ' s', u: '°', si: true,
  };
}

/** Positive angles lean to the left, as the film shows them. @param {number} side */
export function sideWords(side) {
  return side > 0 ? 'to the left (θ > 0)' : 'to the right (θ < 0)';
}

/** @param {number} count */
export function impactWords(count) {
  if (count === 0) return 'without an impact';
  return count === 1 ? 'after 1 impact' : `after ${count} impacts`;
}

/** @param {number} time  pivot time @param {ShownUnits} units */
export function timeText(time, units) {
  return units.si ? `${numeral(time * units.time, 4)} s` : `pt = ${numeral(time, 4)}`;
}
