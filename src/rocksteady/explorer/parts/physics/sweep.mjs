// An attractor followed while a parameter changes in small steps, as `rocksteady.sweep_attractor`
// (dynamics/orbits/attractor_sweep.py), and the symmetric steady states over the same values.

/** @import { Kernels, Section } from '../kernels/loader.mjs' */
/** @import { Case, Start } from './case.mjs' */
/** @import { Impact } from './start.mjs' */
/** @import { Attractor } from './attractor.mjs' */
import { evaluateEach, systemOf } from './case.mjs';
import { ATTRACTOR_KINDS, attractorOf } from './attractor.mjs';
import { NoStart, steadyTable } from './start.mjs';

/** @typedef {'w'|'a'} SweptBy  over the frequency ratio or over the amplitude */

/**
 * With what the next value of a sweep begins.
 * @typedef {object} Carry
 * @property {Start} begin  where the motion begins if none is carried
 * @property {Impact | null} carried  the state from which it goes on
 */

/**
 * Some steps of a sweep, an element a value.
 * @typedef {object} SweepSteps
 * @property {Int8Array} kinds  index of ATTRACTOR_KINDS
 * @property {Int32Array} periods  forcing periods of the orbit; 0 without one
 * @property {Int32Array} impacts  in a period of the orbit; -1 for infinitely many, 0 without one
 * @property {Float64Array[]} peaks  extreme theta/alpha of each flight, with its side
 * @property {(Impact | null)[]} states  on the motion: of its orbit the first
 * @property {string[]} reasons  why a step is undecided
 * @property {Carry} carry  for the steps that follow
 */

export const STRIP_VALUES = 201; // of a sweep of the page
const SHOWN_FLIGHTS = 200; // of a motion without an orbit
const ENDS = [3, 4, 5]; // of the return map: it falls, it stays at rest, no impact is found
const CARRIED_KINDS = ['symmetric', 'unsymmetric', 'aperiodic'];

/**
 * Return a case with another value of the parameter that a sweep is over.
 * @param {Case} given
 * @param {SweptBy} by
 * @param {number} value
 * @returns {Case}
 */
export function movedCase(given, by, value) {
  return by === 'w' ? { ...given, frequencyRatio: value } : { ...given, amplitude: value };
}

/**
 * Return values from an end to the other, evenly spaced as `numpy.linspace` has them, or by ratio.
 * @param {Kernels} kernels
 * @param {{ from: number, to: number, log: boolean }} ends
 * @param {number} count
 * @returns {Float64Array}
 */
export function sweepValues(kernels, { from, to, log }, count) {
  const [first, last] = log ? evaluateEach(kernels, 'log', [from, to]) : [from, to];
  const step = (last - first) / (count - 1);
  const even = Float64Array.from({ length: count }, (_, place) => place * step + first);
  const found = log ? evaluateEach(kernels, 'exp', even) : even;
  found[0] = from;
  found[count - 1] = to;
  return found;
}

/**
 * Go through values in their order, until the last or until a time has passed: a job of the pool.
 * @param {Kernels} kernels
 * @param {{ given: Case, by: SweptBy, values: ArrayLike<number>, carry: Carry, cycles?: number,
 *   milliseconds?: number }} asked  one step at least is made
 * @returns {SweepSteps}
 */
export function sweepSteps(kernels, asked) {
  const { given, by, values, cycles = 2000, milliseconds = Infinity } = asked;
  const since = performance.now();
  const kinds = [], periods = [], impacts = [], peaks = [], states = [], reasons = [];
  let { begin, carried } = asked.carry;
  for (let step = 0; step < values.length; step += 1) {
    if (step && performance.now() - since > milliseconds) break;
    const here = movedCase(given, by, values[step]);
    const found = carried ? attractorOf(kernels, here, { kind: 'impact', ...carried }, cycles)
      : attractorFromStart(kernels, here, begin, cycles);
    if (found.kind === 'rest') begin = { kind: 'rest' };
    carried = CARRIED_KINDS.includes(found.kind) ? found.orbit?.states[0] ?? found.state : null;
    kinds.push(ATTRACTOR_KINDS.indexOf(found.kind));
    periods.push(found.period ?? 0);
    impacts.push(found.orbit ? found.impacts ?? -1 : 0);
    peaks.push(flightPeaks(kernels, here, found));
    states.push(carried);
    reasons.push(found.reason);
  }
  return {
    kinds: Int8Array.from(kinds), periods: Int32Array.from(periods),
    impacts: Int32Array.from(impacts), peaks, states, reasons, carry: { begin, carried },
  };
}

/**
 * Return the extreme theta/alpha of each flight of an attractor, with its side.
 * @param {Kernels} kernels
 * @param {Case} given
 * @param {Attractor} found
 * @returns {Float64Array}  of an orbit's period, or of the next 200 flights of an aperiodic motion
 */
export function flightPeaks(kernels, given, found) {
  /** @type {number[]} */
  const peaks = [];
  if (!found.orbit && (!found.state || !CARRIED_KINDS.includes(found.kind))) {
    return Float64Array.from(peaks);
  }
  const system = systemOf(kernels, given);
  if (found.orbit) {
    for (const state of found.orbit.states) {
      const here = impactSection(kernels, state), step = kernels.next_passage(system, here, -1);
      const [near, far] = kernels.highest_after(system, here, step);
      peaks.push(here.side * near);
      if (far > 0) peaks.push(-here.side * far);
    }
    return Float64Array.from(peaks.filter(Number.isFinite));
  }
  let here = impactSection(kernels, /** @type {Impact} */ (found.state));
  for (let flight = 0; flight < SHOWN_FLIGHTS; flight += 1) {
    const step = kernels.next_passage(system, here, -1);
    if (ENDS.includes(step.kind)) break;
    peaks.push(here.side * kernels.highest_after(system, here, step)[0]);
    here = step.state;
  }
  return Float64Array.from(peaks);
}

/**
 * Return a state as the kernels see it.
 * @param {Kernels} kernels
 * @param {Impact} state
 * @returns {Section}
 */
export function impactSection(kernels, { side, phase, speed }) {
  const [half_cycles, rest] = kernels.clock(phase);
  return { side, half_cycles, phase: rest, speed };
}

/**
 * One solution in closed form over the values, an element a value.
 * @typedef {object} SteadyCurve
 * @property {number} order  1, or 3 for the 1/3 subharmonic
 * @property {number} branch
 * @property {Float64Array} peaks  theta/alpha; nan where there is no such motion
 * @property {Uint8Array} stable
 * @property {Float64Array} phases  of the shaking at the impact that begins a positive half cycle
 * @property {Float64Array} speeds  du/d(pt) after it
 */

/**
 * Return the symmetric steady states of the linear model over values, as
 * `rocksteady.compute_response_curve` has them over the frequency ratio.
 * @param {Kernels} kernels
 * @param {{ given: Case, by: SweptBy, values: ArrayLike<number>, orders: number[] }} asked
 * @returns {SteadyCurve[]}
 */
export function steadyCurves(kernels, { given, by, values, orders }) {
  const count = values.length, all = Array.from(values);
  const amplitude = by === 'a' ? all : all.map(() => given.amplitude);
  const ratio = by === 'w' ? all : all.map(() => given.frequencyRatio);
  const { restitution } = given, least = 1 + restitution * restitution;
  return orders.flatMap((order) => {
    const { phase, velocity, trace, peak, admissible } =
      steadyTable(kernels, amplitude, ratio, restitution, order);
    return [1, 2].map((branch) => {
      const first = (branch - 1) * count;
      return {
        order,
        branch,
        peaks: Float64Array.from(all, (_, k) => (admissible[first + k] ? peak[first + k] : NaN)),
        stable: Uint8Array.from(all, (_, k) => Number(admissible[first + k] !== 0
          && restitution < 1 && Math.abs(trace[first + k]) < least)),
        phases: phase.slice(first, first + count),
        speeds: Float64Array.from(all, (_, k) => ratio[k] * velocity[first + k]),
      };
    });
  });
}

/**
 * Return what the block settles to from a start, or from rest where there is none such.
 * @param {Kernels} kernels
 * @param {Case} given
 * @param {Start} start
 * @param {number} cycles
 */
function attractorFromStart(kernels, given, start, cycles) {
  try {
    return attractorOf(kernels, given, start, cycles);
  } catch (error) {
    if (!(error instanceof NoStart)) throw error;
    return attractorOf(kernels, given, { kind: 'rest' }, cycles);
  }
}
