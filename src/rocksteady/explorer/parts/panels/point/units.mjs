// Units of the panels of the point: dimensionless, or degrees, seconds and millimetres.

import { evaluate } from '../../physics/case.mjs';
import { FULL_TURN } from '../../physics/start.mjs';
import { numeral } from '../../draw/scale.mjs';
import { shownUnits } from '../../shell/units.mjs';

/** @import { App } from '../../shell/app.mjs' */
/** @import { Measures } from '../../physics/case.mjs' */

/**
 * Return the units of axes; a value times `factor` is what the axis shows.
 * @param {App} app
 * @param {Measures} block
 */
export function panelUnits({ state, theme }, block) {
  const si = state.units === 'si', shown = shownUnits(theme.units, block, si), period = FULL_TURN / state.W;
  const { time, angle } = shown, factor = time.factor * period, periods = 'time [forcing periods]';
  return {
    ...shown, si,
    angle: { ...angle, unit: angle.unit || 'α' },
    time: si ? { factor, label: time.label, unit: 's', far: { factor, label: periods } }
      : { factor: 1, label: periods, unit: 'T' },
  };
}

/**
 * Return an angle in words: in alpha, or in degrees with the displacement of the top.
 * @param {App} app
 * @param {Measures} block
 * @param {number} angle  theta/alpha
 */
export function angleWords(app, block, angle) {
  if (app.state.units !== 'si') return `${numeral(angle, 3)} α`;
  const degrees = numeral((angle * block.alpha * 180) / Math.PI, 3);
  return `${degrees}° (top ${numeral(1000 * topDisplacement(app, block, angle), 3)} mm)`;
}

/**
 * Return how far the top goes to the side when the block rotates about its corner [m].
 * @param {App} app
 * @param {Measures} block
 * @param {number} angle  theta/alpha
 */
export function topDisplacement({ kernels }, { alpha, radius }, angle) {
  const size = Math.abs(angle) * alpha;
  const sine = (/** @type {number} */ x) => evaluate(kernels, 'sin', x);
  return Math.sign(angle) * 2 * radius * (sine(alpha) - sine(alpha - size));
}

/**
 * Return the least of some round numbers that holds a value.
 * @param {number} value
 */
export function roundLimit(value) {
  const steps = [0.02, 0.05, 0.1, 0.2, 0.3, 0.5, 0.75, 1.1, 1.5, 2.1, 3.2, 5, 7.5];
  return steps.find((step) => step >= 1.05 * value) ?? 1.1 * value;
}
