// The line through the point along which the strip runs, its units, and the steps of a sweep.

/** @import { App } from '../shell/app.mjs' */
/** @import { State } from '../shell/state.mjs' */
/** @import { Case, Start } from '../physics/case.mjs' */
/** @import { SteadyCurve, SweptBy } from '../physics/sweep.mjs' */
/** @import { Impact } from '../physics/start.mjs' */
import { numeral } from '../draw/scale.mjs';
import { STRIP_VALUES } from '../physics/sweep.mjs';
import { caseOf } from '../shell/state.mjs';
import { pageUnits } from '../shell/units.mjs';

/**
 * One sweep, as far as it has come: an element a value, in the order of the values.
 * @typedef {object} Sweep
 * @property {'up' | 'down'} way
 * @property {string} from  the start in words
 * @property {Start} start
 * @property {string[]} kinds
 * @property {number[]} periods  0 without an orbit
 * @property {Float64Array[]} peaks
 * @property {(Impact | null)[]} states
 * @property {string[]} reasons
 */

/**
 * The line in the plane that is swept, and what is known of it.
 * @typedef {object} StripRun
 * @property {string} key
 * @property {Case} given
 * @property {SweptBy} by
 * @property {number} from
 * @property {number} to
 * @property {boolean} log
 * @property {Float64Array} values  ascending
 * @property {Sweep[]} sweeps  upward, downward
 */

/** What the drawing needs. @typedef {object} StripView
 * @property {StripRun | null} run  the last that was begun
 * @property {boolean} stale  whether that is of another line than the present one
 * @property {{ key: string, values: Float64Array, curves: SteadyCurve[] } | null} closed
 * @property {State} state
 * @property {SweptBy} by
 * @property {{ x: number, y: number, label: string, angleLabel: string }} units  factors
 * @property {{ from: number, to: number, log: boolean }} window
 * @property {number | null} hovered  place of a value
 * @property {number[]} present  peaks of the motion at the point
 */

/**
 * Return the place of a value in a sweep's steps, or of a step's value.
 * @param {Sweep} sweep
 * @param {number} place
 */
export function placeInSweep({ way }, place) {
  return way === 'up' ? place : STRIP_VALUES - 1 - place;
}

/**
 * Return the angles of the dots of a step; a block at rest has one at 0.
 * @param {Sweep} sweep
 * @param {number} step
 * @returns {Float64Array | number[]}
 */
export function dotAngles({ kinds, peaks }, step) {
  return kinds[step] === 'rest' ? [0] : peaks[step];
}

/**
 * Return whether steps of two sweeps are on the same motion, or on its mirror image.
 * @param {Sweep} one
 * @param {number} step
 * @param {Sweep} other
 * @param {number} back
 */
export function sameStep(one, step, other, back) {
  if (one.kinds[step] !== other.kinds[back]) return false;
  if (one.periods[step] !== other.periods[back]) return false;
  if (!one.periods[step]) return true;
  const most = [one.peaks[step], other.peaks[back]].map((peaks) =>
    peaks.reduce((highest, u) => Math.max(highest, Math.abs(u)), 0));
  return Math.abs(most[0] - most[1]) <= 1e-6 * Math.max(...most, 1e-3);
}

/**
 * Return the line through the point along which the strip runs.
 * @param {App} app
 * @param {State} state
 */
export function stripLine(app, state) {
  const given = caseOf(app.kernels, state), { by } = state;
  const [low, to] = by === 'w' ? [state.w0, state.w1] : [state.a0, state.a1];
  const log = state.log === 1, from = log ? Math.max(low, 0.001 * to) : low;
  const { alpha, restitution, nonlinear } = given;
  const kept = by === 'w' ? state.A : state.W;
  const key = [by, from, to, log, kept, restitution, nonlinear ? alpha : 'linear'].join(' ');
  return { key, given, by, from, to, log };
}

/**
 * Return factors and names of the axes in the units chosen.
 * @param {App} app
 * @param {State} state
 */
export function stripUnits(app, state) {
  const { amplitude, frequency, flight } = pageUnits(app, state), si = state.units === 'si';
  const [w, a] = si ? ['f', 'a'] : ['Ω', 'A'], over = state.by === 'w', swept = over ? frequency : amplitude;
  return {
    x: swept.factor, y: flight.factor, symbol: over ? w : a, unit: swept.unit.trim(), angleUnit: flight.unit,
    label: swept.label, angleLabel: flight.label, far: swept.far,
    fixed: over ? `${a} = ${numeral(state.A * amplitude.factor)}${amplitude.unit}`
      : `${w} = ${numeral(state.W * frequency.factor)}${frequency.unit}`,
  };
}
