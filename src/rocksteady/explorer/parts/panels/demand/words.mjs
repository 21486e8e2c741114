// Words and units that the panels of pulses and designs share.

/** @import { App } from '../../shell/app.mjs' */
/** @import { State } from '../../shell/state.mjs' */
import { numeral } from '../../draw/scale.mjs';
import { pageUnits } from '../../shell/units.mjs';

/**
 * Return how pulses and runs are shown: factors, the words after a number, and axes.
 * @param {App} app
 * @param {State} state
 * @param {boolean} [si]
 */
export function unitsOf(app, state, si = state.units === 'si') {
  const axes = pageUnits(app, state, si), { amplitude, frequency, time, angle } = axes;
  return {
    amplitude: amplitude.factor, frequency: frequency.factor, time: time.factor, angle: angle.factor,
    a: amplitude.unit, f: frequency.unit, u: angle.unit || ' α', si, axes,
  };
}

/** @typedef {ReturnType<typeof unitsOf>} ShownUnits */

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
