// Units of the page: g, Hz, degrees and seconds of the block, by the table of `explorer/_units.py`.

/** @import { App } from './app.mjs' */
/** @import { State } from './state.mjs' */
import { numeral } from '../draw/scale.mjs';
import { blockNumbers } from './state.mjs';

/** @typedef {{ near: string, far: string, factor: [number, number, number] }} Quantity */
/**
 * A quantity on an axis: a dimensionless value times `factor` is shown, with `unit` after it.
 * @typedef {{ factor: number, label: string, unit: string, far?: { factor: number, label: string } }} Shown
 */
/** @typedef {'amplitude' | 'frequency' | 'time' | 'angle' | 'velocity' | 'startAngle' | 'startVelocity'
 *   | 'speed' | 'peak' | 'flight' | 'base'} QuantityName */
/** @typedef {Record<QuantityName, Quantity>} Quantities */

/**
 * Return how each quantity is shown, in the units of the block or dimensionless.
 * @param {Quantities} table
 * @param {{ alpha: number, p: number }} block
 * @param {boolean} si
 * @returns {Record<QuantityName, Shown>}
 */
export function shownUnits(table, { alpha, p }, si) {
  const shown = Object.entries(table).map(([name, { near, far, factor: [one, slender, rate] }]) => {
    if (!si) return [name, { factor: 1, label: far, unit: '' }];
    const factor = one * alpha ** slender * p ** rate, unit = near.match(/\[(.*)\]/)?.[1] ?? '';
    return [name, { factor, label: near, unit: unit === '°' ? unit : ` ${unit}`, far: { factor, label: far } }];
  });
  return Object.fromEntries(shown);
}

/**
 * Return a shaking in words.
 * @param {Record<QuantityName, Shown>} units
 * @param {{ A: number, W: number }} shaking
 */
export function shakingWords({ amplitude, frequency }, { A, W }) {
  const [a, w] = [`${numeral(A * amplitude.factor)}${amplitude.unit}`, `${numeral(W * frequency.factor)}${frequency.unit}`];
  return amplitude.unit ? `${a}, ${w}` : `A = ${a}, Ω = ${w}`;
}

/**
 * Return how each quantity is shown on the page.
 * @param {App} app
 * @param {State} [state]
 * @param {boolean} [si]
 */
export function pageUnits(app, state = app.state, si = state.units === 'si') {
  return shownUnits(app.theme.units, blockNumbers(app.kernels, state), si);
}
